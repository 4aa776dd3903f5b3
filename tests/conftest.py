"""Settings that all tests share."""

from hypothesis import settings

settings.register_profile("gark", deadline=None, max_examples=40)
settings.load_profile("gark")
