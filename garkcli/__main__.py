"""``gark``, which is also ``python -m garkcli``; no other module imports this one."""

from garkcli.leaving import leave_at_once

leave_at_once()  # the next import takes most of the time of a short command

from garkcli.cli import main  # noqa: E402

if __name__ == "__main__":
    main()
