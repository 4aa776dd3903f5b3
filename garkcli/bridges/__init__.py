"""Other people's formats: a file per target under ``targets``, per source under ``readers``."""
