"""Pictures of results: scenes, which say what is drawn, and what draws them."""
