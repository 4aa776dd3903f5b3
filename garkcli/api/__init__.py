"""The Python interface: the functions behind the commands, for methods from files and from arrays.

``garkcli`` itself hands out what is here; nothing of the program imports it.
"""
