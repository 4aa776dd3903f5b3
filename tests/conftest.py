"""Settings that all tests share."""

import os
import sys

from hypothesis import settings

# The suite starts gark some hundred times: byte code is kept, whatever the environment says.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

settings.register_profile("gark", deadline=None, max_examples=40)
settings.load_profile("gark")
