"""Other people's formats: one file a target under ``targets``, one a source under ``readers``."""
