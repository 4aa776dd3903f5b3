"""The page of ``gark report``: well-formed, without a network, and saying what the other reports
say.
"""

from __future__ import annotations

import pytest

from garkcli.errors import MethodError
from garkcli.webpage.calls import report_page


def test_a_page_of_nothing_is_refused() -> None:
    """A call without methods is a mistake that is told."""
    with pytest.raises(MethodError, match="at least one"):
        report_page()
