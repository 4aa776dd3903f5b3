"""Python without what Windows lacks, for the circumstance ``no-unix`` of ``make portable``: put into
the folder of packages of a virtual environment, it is run at the start of each process.
"""

import multiprocessing
import os
import signal
import sys

MODULES = ("fcntl", "grp", "pwd", "pty", "resource", "syslog", "termios")
"""To import one of these is an error."""
OF_OS = ("fork", "forkpty", "geteuid", "mkfifo", "nice")
OF_SIGNAL = (
    "SIGALRM",
    "SIGHUP",
    "SIGPIPE",
    "SIGUSR1",
    "alarm",
    "pthread_sigmask",
    "setitimer",
)

for name in MODULES:
    sys.modules[name] = None
for module, names in ((os, OF_OS), (signal, OF_SIGNAL)):
    for name in names:
        if hasattr(module, name):
            delattr(module, name)
multiprocessing.get_all_start_methods = lambda: ["spawn"]
multiprocessing.set_start_method("spawn")
