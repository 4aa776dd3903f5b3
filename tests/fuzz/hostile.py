"""Files made to be slow or large rather than wrong, each by one amplifier, for ``long_run.py
--hostile``.
"""

from __future__ import annotations

from collections.abc import Mapping


def _number(text: str) -> str:
    return f'methods: [{{A: [["{text}"]], b: [1]}}]'


def _list(items: list[str]) -> str:
    return f"[{', '.join(items)}]"


def _square(entry: str, size: int) -> str:
    return _list([_list([entry] * size)] * size)


def hostile_files() -> Mapping[str, str]:
    """Every hostile file by name."""
    return {**_numbers(), **_repetitions(), **_sizes(), **_texts(), **_nestings()}


def hostile_problems() -> Mapping[str, str]:
    """Every hostile problem file by name."""
    from tests.problems.files.test_hostile import READ, REFUSED

    return {**{name: text for name, (text, _) in REFUSED.items()}, **READ}


def _numbers() -> Mapping[str, str]:
    """One coefficient that costs much."""
    primes, sevens, threes = (2, 3, 5, 7, 11), "7" * 900, "3" * 900
    roots = "+".join(f"sqrt({p})" for p in primes)
    return {
        "roots of a hidden zero": _number("sqrt(" * 40 + "sqrt(2)*sqrt(2)-2" + ")" * 40),
        "nested square roots": _number("sqrt(1+" * 5 + "2" + ")" * 5),
        "five square roots": _number(roots),
        "the inverse of five square roots": _number(f"1/({roots})"),
        "a power of five square roots": _number(f"(1+{roots})**-64"),
        "many products of radicals": _number("*".join([f"(1+{roots})"] * 200)),
        "many quotients of radicals": _number("/".join([f"(1+{roots})"] * 200)),
        "long radicands": _number(f"root({sevens},12)+root({threes},4)"),
        "long nested radicands": _number(f"root({sevens}+root({threes},4),12)"),
        "the inverse of a long nested radicand": _number(f"root(1/({sevens}+root({threes},4)),12)"),
        "long radicands five deep": _number(
            "".join(f"sqrt({str(k) * 900}+" for k in range(1, 6)) + "1" + ")" * 5
        ),
        "a radicand close to zero": _number("sqrt(((((sqrt(2)-1)**64)**8)**4)**4)"),
        "a power of a power": _number(f"((((sqrt(2)+root(3,12)+{'7' * 30})**64)**8)**4)"),
        "many inverses": _number(
            "+".join(f"1/(root(5,4)+cbrt(3)+sqrt(5+sqrt(8))+{k})" for k in range(300))
        ),
        "a sum of fractions": _number("+".join(f"1/{10**6 + i}" for i in range(1900))),
        "many digits": _number("1" * 980_000),
        "an exponent": _number("1e999999999999999999999"),
    }


def _repetitions() -> Mapping[str, str]:
    """One costly thing, used often."""
    sum_of_ones, roots = "+".join(["1"] * 1900), "+".join(["sqrt(3)"] * 900)
    radicals = "sqrt(2)+sqrt(3)+sqrt(5)+sqrt(7)+sqrt(11)"
    coefficients = [
        f'"{"+".join(f"1/{10**20 + i + 77 * j}" for i in range(600))}"' for j in range(200)
    ]
    culprits = [
        f'"{"+".join(f"sqrt({p + k})" for k in (0, 1, 2, 4, 5))}"' for p in range(10**5, 10**5 + 60)
    ]
    chain = "".join(f", p{i}: p{i - 1}+1" for i in range(1, 1500))
    six = f'"{radicals}+sqrt(13)"'
    return {
        "one degree too many, often": f"methods: [{{A: [{_list([six] * 10_000)}], b: [1]}}]",
        "aliases of a long number": f'name: &a "{sum_of_ones}"\n'
        f"methods: [{{A: [{_list(['*a'] * 49_000)}], b: [1]}}]",
        "a long parameter": f'parameters: {{p: "{roots}"}}\nmethods: [{{A: [{_list(["p"] * 49_000)}], b: [1]}}]',
        "a chain of parameters": f"parameters: {{p0: 1{chain}}}\nmethods: [{{A: [[p1499]], b: [1]}}]",
        "unknown parameters": f"parameters: {{{', '.join(f'p{i}: 1' for i in range(3000))}}}\n"
        f"methods: [{{A: [{_list([f'q{i}' for i in range(3000)])}], b: [1]}}]",
        "one fault among radicals": f'name: &a "{radicals}"\n'
        f"methods: [{{A: [{_list(['*a'] * 1000 + ['sqrt(-1)'])}], b: [1]}}]",
        "too many radicals together": f"methods: [{{A: [{_list([*culprits, 'sqrt(-1)'])}], b: [1]}}]",
        "long sums": f"methods: [{{A: [{_list(coefficients)}], b: [1]}}]",
    }


def _sizes() -> Mapping[str, str]:
    """Methods of many stages or colours."""
    blocks = f'{{"1,2": {_list(["[1]"] * 60)}}}'
    fractions = _list([_list([f"{i}/{i + j + 1}" for j in range(100)]) for i in range(100)])
    hundred = f"{{A: {fractions}, b: {_list([f'1/{i + 1}' for i in range(100)])}}}"
    constant = f"{{A: {_square('1/3', 220)}, b: {_list(['1'] * 220)}}}"
    return {
        "many colours": f"methods: {_list(['{family: gauss, stages: 1}'] * 9_000)}\ntransfer: collocation",
        "blocks of many entries": f"methods: {_list(['{family: gauss, stages: 200}'] * 100)}\n"
        "transfer: collocation",
        "many colours of an ark": f"ark: {{A: {_list(['[[1]]'] * 12_000)}, b: [1]}}",
        "many colours of a tableau": f"tableau: {{A: {_list(['[]'] * 12_000)}, b: {_list(['[1]'] * 12_000)}}}",
        "aliases of a colour": f"methods: {_list(['&a {family: gauss, stages: 1}', *['*a'] * 9_000])}\n"
        "transfer: collocation",
        "a hundred colours": f"methods: {_list(['{family: gauss, stages: 4}'] * 100)}\ntransfer: collocation",
        "a family of many stages": "methods: [{family: gauss, stages: 999999}]",
        "a spelled-out block beside a family": "methods: [{family: gauss, stages: 60}, {A: [[1/2]], b: [1]}]\n"
        f"transfer: {{default: collocation, blocks: {blocks}}}",
        "many stages": f"methods: [{constant}]",
        "many stages beside a family": f"methods: [{constant}, {{family: gauss, stages: 2}}]\n"
        "transfer: collocation",
        "collocation at many nodes": f"methods: [{hundred}, {{family: gauss, stages: 9}}]\ntransfer: collocation",
        "the conjugate of many stages": f"conjugate: true\nmethods: [{hundred}]",
        "interpolation at many nodes": f"methods: [{hundred}, {hundred}]\ntransfer: interpolation",
        "the conjugate of many equal stages": "conjugate: true\n"
        f"ark: {{A: [{_square('1/3', 220)}], b: {_list(['1'] * 220)}}}",
    }


def _texts() -> Mapping[str, str]:
    """Much text for YAML or for the messages."""
    return {
        "underscores": f"methods: [{{A: [[{'_' * 100_000}x]], b: [1]}}]",
        "unknown keys": "\n".join(f"methodx{i}: 1" for i in range(24_000)),
        "doubled keys": "name: 1\n" * 24_000,
        "many faults": f"methods: [{{A: [{_list(['x'] * 49_000)}], b: [1]}}]",
        "many faults of YAML's numbers": f"methods: [{{A: [{_list(['010'] * 49_000)}], b: [1]}}]",
        "a long value": f"name: {'x' * 980_000}",
        "a long key": f"{'methods' * 140_000}: 1",
        "a long family": f"methods: [{{family: {'gauss' * 190_000}}}]",
        "a long tag": f"name: {'!' * 980_000}",
        "a long quoted value": f'name: "{chr(10) * 980_000}"',
        "a long block": "name: |\n" + " \n" * 480_000,
        "comments": "# x\n" * 240_000,
        "spaces": " " * 980_000 + "name: 1",
        "many directives": "".join(f"%TAG !a{i}! tag:x\n" for i in range(40_000)) + "---\nname: 1",
        "many anchors": f"name: {_list([f'&a{i} 1' for i in range(24_000)])}",
        "a surrogate": "name: \ud800",
    }


def _nestings() -> Mapping[str, str]:
    """Many values, or values in values."""
    names = "bcdefghijkl"
    bomb = "".join(f"{x}: &{x} {_list([f'*{chr(ord(x) - 1)}'] * 9)}\n" for x in names)
    return {
        "half a million values": f"name: [{'1,' * 490_000}1]",
        "many empty lists": f"name: [{'[],' * 320_000}1]",
        "half a million keys": f"{{{'a,' * 480_000}}}",
        "brackets": "[" * 990_000,
        "a few thousand brackets": "[" * 4_990,
        "a few thousand braces": "{a: " * 1_200,
        "a few thousand dashes": "- " * 2_490,
        "a few thousand question marks": "? " * 2_490,
        "question marks": "? " * 490_000,
        "aliases of aliases": f"a: &a {_list(['1'] * 9)}\n{bomb}",
        "a list in itself": "methods: &a [*a]",
        "claims": f"expect: {{C: [{'[],' * 49_000}[]]}}\nmethods: [{{family: gauss, stages: 1}}]",
    }
