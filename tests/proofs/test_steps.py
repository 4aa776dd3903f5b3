"""The theory in ``proofs/``, as far as it is seen without Coq."""

from __future__ import annotations

import re

import pytest

from tests.proofs.run import ROOT, STEPS

FILES = {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "proofs").glob("*.v")}
README = (ROOT / "proofs" / "README.md").read_text(encoding="utf-8")


def test_every_file_is_compiled_and_described() -> None:
    """``make proofs`` and the commands of the page name all files; so does its table, in order."""
    assert sorted(FILES) == sorted(STEPS)
    assert re.findall(r"^\| `(\w+)\.v`", README, re.MULTILINE) == list(STEPS)
    assert f"for step in {' '.join(STEPS)}; do" in README


@pytest.mark.parametrize("step", STEPS)
def test_a_step_needs_those_before_it_and_assumes_nothing(step: str) -> None:
    """Imports come earlier in the list; nothing is admitted or taken for an axiom."""
    imports = " ".join(re.findall(r"^From Gark Require Import ([^.]*)", FILES[step], re.MULTILINE))
    assert set(imports.split()) <= set(STEPS[: STEPS.index(step)])
    words = r"\b(Admitted|admit|Axioms?|Parameters?|Conjecture)\b"
    assert not re.search(words, FILES[step])


@pytest.mark.parametrize("name", re.findall(r"`(theorem_\w+|has_order|criterion)\b", README))
def test_names_of_the_page_exist(name: str) -> None:
    """What the page calls a theorem or a definition is one."""
    declared = rf"^(Theorem|Corollary|Definition) {name}\b"
    assert any(re.search(declared, text, re.MULTILINE) for text in FILES.values())
