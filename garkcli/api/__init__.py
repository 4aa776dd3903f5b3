"""The Python interface: the functions behind the commands, for methods from files and from arrays.

``garkcli`` exports them; no other part of the program imports this package.
"""
