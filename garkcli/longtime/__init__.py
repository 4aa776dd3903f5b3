"""Energy and other invariants over a long time."""
