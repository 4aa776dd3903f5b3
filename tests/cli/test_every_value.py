"""Commands on files with free parameters: what they print of every value is true of each."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest
from flint import fmpq

from garkcli.check.every_family import every_family
from garkcli.design.member import member
from garkcli.design.stability_functions import family_functions
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import loads
from garkcli.order.admissible import elementary_weight
from garkcli.order.conditions import all_conditions
from garkcli.report.schemas import report_schema
from garkcli.stability.linear import e_polynomial, stability_function
from garkcli.tableau.forms import pair
from tests.cli.harness import gark
from tests.whole import in_whole

SDIRK = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
TAU = """parameters: {tau: free}
methods:
  - {family: gauss, stages: 2}
  - {family: lobatto-iiia, stages: 3}
transfer: {interpolation: tau, collocation: 1 - tau}
"""
SEVERAL = "unknown: {stages: 2, shape: explicit}\n"


@pytest.mark.parametrize("text", [SDIRK, TAU])
@pytest.mark.parametrize("command", ["tableau", "conjugate"])
def test_printed_entries_are_the_family(text: str, command: str, tmp_path: Path) -> None:
    """The tableau as a method file, loaded again with a value, is that of the file with the value:
    entries in radicals of the nodes and in the parameter.
    """
    path, made = tmp_path / "family.yaml", tmp_path / "made.yaml"
    path.write_text(text, encoding="utf-8")
    written = gark(command, str(path), "--format", "yaml", "-o", str(made))
    assert written.code == 0
    name = loads_family(text).parameters[0]
    chosen = ["--set", f"{name}=2/5", "--format", "json"]
    direct = json.loads(gark(command, str(path), *chosen).out)
    again = json.loads(gark("tableau", str(made), *chosen).out)
    for part in ("c", "A", "b"):
        assert direct[part] == again[part]


def test_latex_and_json_have_the_parameters(tmp_path: Path) -> None:
    """Greek letters and indices in LaTeX; JSON as its schema says, no floats for functions."""
    path = tmp_path / "family.yaml"
    path.write_text(TAU, encoding="utf-8")
    assert r"\frac{\tau \sqrt{3}}{12}" in gark("tableau", str(path), "--format", "latex").out
    path.write_text(SEVERAL, encoding="utf-8")
    assert "b_{1} & b_{2}" in gark("tableau", str(path), "--format", "latex").out
    data = json.loads(gark("tableau", str(path), "--format", "json").out)
    jsonschema.validate(data, report_schema("tableau"))
    assert data["b"] == [["b1", "b2"]]
    assert data["float"]["b"] == [[None, None]]


@pytest.mark.parametrize("option", ["--digits=5", "--sort=worst"])
def test_numbers_are_refused_with_the_cure(option: str, tmp_path: Path) -> None:
    """What needs numbers says which parameter is free and how to choose it."""
    path = tmp_path / "family.yaml"
    path.write_text(SDIRK, encoding="utf-8")
    refused = gark("conditions", str(path), option)
    assert (refused.code, "--set g=1/2" in refused.err) == (2, True)


def test_conditions_have_their_polynomials(tmp_path: Path) -> None:
    """The value of each condition of the pair is a function whose value at 2/5 is that of the
    method there; the report counts what not every value meets.
    """
    family = every_family(loads_family(TAU))
    value = fmpq(2, 5)
    plain = pair(loads(TAU, settings={"tau": "2/5"}).tableau)
    both = pair(family.tableau)
    values = {"tau": value}
    for order in range(1, 5):
        for condition in all_conditions(both, order):
            at = elementary_weight(plain, condition.tree)
            function = condition.value
            if not isinstance(function, fmpq):
                numerator = function.numerator(value)
                function = numerator / function.denominator(value)
            assert function == at
    assert member(both, family.ring, values).blocks == plain.blocks
    path = tmp_path / "family.yaml"
    path.write_text(SDIRK, encoding="utf-8")
    text = gark("conditions", str(path), "--order", "3").out
    assert "off by -g^2 + g - 1/6" in text
    assert text.endswith("4 conditions, 2 do not hold for every value\n")


@pytest.mark.parametrize(
    "text",
    [
        *(SDIRK, TAU),
        "parameters: {g: free}\nA: [[g]]\nb: [g]\n",
        "parameters: {g: free}\nA: [[0, 0], [g, 0]]\nb: [1/2, 1/2]\n",
    ],
)
def test_stability_functions_are_those_of_each_value(text: str) -> None:
    """R, E and R(∞) with a value for the parameter are those of the method with the value, found by
    the power series of the step; R(∞) is a number, 0, or unbounded.
    """
    family = every_family(loads_family(text))
    [name] = family.family.parameters
    found = family_functions(family.tableau, family.ring)[0]
    for value in (fmpq(2, 5), fmpq(-3, 7)):

        def at(coefficients: tuple[object, ...], t: fmpq = value) -> list[fmpq]:
            numbers = []
            for a in coefficients:
                if isinstance(a, fmpq):
                    numbers.append(a)
                else:
                    numbers.append(a.numerator(t) / a.denominator(t))  # type: ignore[attr-defined]
            return numbers

        R = stability_function(loads(text, settings={name: str(value)}).tableau)
        assert at(found.numerator) == list(R.numerator.coefficients)
        assert at(found.denominator) == list(R.denominator.coefficients)
        E = list(e_polynomial(R).coefficients)
        assert at(found.e_polynomial)[: len(E)] == E
        limit = found.at_infinity
        assert R.at_infinity() == (None if limit is None else at((limit,))[0])


@in_whole
def test_stability_as_a_command(tmp_path: Path) -> None:
    """R(z) with its coefficients, the sets of values, and JSON as its schema says; several
    parameters are told how it is decided.
    """
    path = tmp_path / "family.yaml"
    path.write_text(SDIRK, encoding="utf-8")
    text = gark("stability", str(path)).out
    assert "1 + (-2*g + 1)*z + (g^2 - 2*g + 1/2)*z^2" in text
    assert "a-stable              yes for 1/4 ≤ g alone" in text
    data = json.loads(gark("stability", str(path), "--format", "json").out)
    jsonschema.validate(data, report_schema("stability-every"))
    assert data["functions"][0]["R_infinity"] == "(g^2 - 2*g + 1/2)/(g^2)"
    assert data["stability"]["p_stable"]["where"][0]["from"] == "1/4"
    formula = gark("stability", str(path), "--format", "latex").out
    assert r"$\frac{1+\left(-2g+1\right)z" in formula
    assert r"}{1-2gz+g^{2}z^{2}}$" in formula
    refused = gark("stability", str(path), "--plot", str(tmp_path / "x.png"))
    assert (refused.code, "--set g=1/2" in refused.err) == (2, True)
    path.write_text(SEVERAL, encoding="utf-8")
    assert "gark design --a-stable" in gark("stability", str(path)).out


@in_whole
def test_the_variable_of_a_polynomial_is_no_parameter(tmp_path: Path) -> None:
    """R and E of explicit methods with a and b for parameters, and the same with z and x: other
    names change nothing else than the letters.
    """
    path = tmp_path / "family.yaml"
    shown = []
    for a, b in ("ab", "zx", "xw"):
        family = f"parameters: {{{a}: free, {b}: free}}\nA: [[0, 0], [{a}, 0]]\nb: [1-{b}, {b}]\n"
        path.write_text(family, encoding="utf-8")
        shown.append(gark("stability", str(path)).out)
    assert "E(x)                  (2*a*b - 1)*x - a^2*b^2*x^2" in shown[0]
    assert "R(w)                  1 + w + z*x*w^2" in shown[1]
    assert "E(u)                  (2*z*x - 1)*u - z^2*x^2*u^2" in shown[1]
    assert "R(z)                  1 + z + x*w*z^2" in shown[2]
    assert "E(u)                  (2*x*w - 1)*u - x^2*w^2*u^2" in shown[2]
