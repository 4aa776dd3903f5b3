"""``python -m garkcli`` is ``gark``."""

from garkcli.cli import main

if __name__ == "__main__":
    main()
