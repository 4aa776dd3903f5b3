"""The Python interface: the functions behind the commands. ``garkcli`` exports them."""
