"""``gark``, which is also ``python -m garkcli``; no other module imports this one."""

import os

from garkcli.leaving import leave_at_once

leave_at_once()  # the next import takes most of the time of a short command
# the matrices of methods are small: threads of numpy's libraries would wait for each other
for _library in ("OPENBLAS", "MKL"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

from garkcli.cli import main  # noqa: E402

if __name__ == "__main__":
    main()
