"""``gark claims``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.options import Output, declared, files_meant
from garkcli.errors import MethodFileError, UsageProblem, did_you_mean
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.check.outcome import Outcome
    from garkcli.check.true_claims import TrueClaims


@declared("claims", FORMATS)
def command(
    files: tuple[str, ...], is_written: bool, wants_all: bool, keys: tuple[str, ...], output: Output
) -> int:
    """What is true of a method, as a file claims it under `expect`.

    Of a file that makes claims these, with what is true in place of what it says; of one that makes
    none the orders, whether it is symplectic, its stage order, and the properties that it has.
    What has no meaning for a method, or is not decided, is not claimed. FILE as for gark check.

    With --write the claims are put into the files: gark check fails from then on where the method
    is no longer what it was.
    """
    from garkcli.check.check_file import check_file
    from garkcli.report.claims import REPORT, Claims, yaml_text

    _refuse_unknown(keys)
    if is_written and "-" in files:
        raise UsageProblem("--write needs a file", "name one in place of -", code="option-alone")
    paths = files_meant(files, output)
    if is_written:
        _refuse_names(paths)
    told = [_claims(check_file(path), wants_all, keys) for path in paths]
    if is_written:
        for claims in told:
            _write(claims)
    found = [Claims(x, is_written) for x in told]
    if output.format == "text":
        output.write(yaml_text(found, output.width))
    else:
        output.tell(REPORT, found)
    return 0


def _refuse_names(paths: list[str]) -> None:
    """A method of the catalogue has no file that is the user's to write."""
    from garkcli.methodfile.naming import find_named

    for path in paths:
        if find_named(path) is not None:
            message = f"--write needs a file, and {path} is a name of the catalogue"
            raise UsageProblem(message, "give the path of the file", code="option-alone")


def _refuse_unknown(keys: tuple[str, ...]) -> None:
    from garkcli.methodfile.expectations import CLAIMS

    for key in keys:
        if key not in CLAIMS:
            cure = did_you_mean(key, CLAIMS)
            raise UsageProblem(f"no claim {key!r}", cure, code="unknown-word")


def _claims(outcome: Outcome, wants_all: bool, keys: tuple[str, ...]) -> TrueClaims:
    """What is true of a method, of that what is asked for.

    Raises:
        MethodFileError: the file is no method.
        UsageProblem: it is a family of them.
    """
    from garkcli.check.true_claims import TrueClaims, true_claims

    if outcome.faults:
        raise MethodFileError(outcome.file, outcome.faults, outcome.text)
    if outcome.analysis is None:
        raise UsageProblem(
            f"{outcome.file} has free parameters, and claims are of one method",
            "gark check says what holds for every value",
            code="free-parameters",
        )
    wanted = _wanted(outcome, outcome.analysis, wants_all, keys)
    found = true_claims(outcome.analysis, wanted)
    left = tuple(key for key in wanted if key not in found)
    return TrueClaims(outcome.file, outcome.text, found, left)


def _wanted(
    outcome: Outcome, analysis: Analysis, wants_all: bool, keys: tuple[str, ...]
) -> list[str]:
    """The claims that are asked for."""
    from garkcli.check.true_claims import usual_keys
    from garkcli.methodfile.expectations import CLAIMS

    if wants_all:
        return list(CLAIMS)
    made = [claim.claim for claim in outcome.claims]
    if not made and not keys:
        made = usual_keys(analysis)
    return [*made, *keys]


def _write(claims: TrueClaims) -> None:
    """Put claims into their file."""
    from garkcli.methodfile.claims_writer import write_claims
    from garkcli.page.writing import write_whole

    text = write_claims(claims.file, claims.text, claims.claims)
    if text != claims.text:
        write_whole(claims.file, [text], is_renewed=True)
