"""Certificates judged by Coq: ``make proofs``.

The theory of ``proofs/`` is compiled, then the file of ``gark export --to certificate --format coq`` for every
exact method of ``methods/`` and of the catalogue. Files with one number changed are refused. Theorem
B says of lines of docs/pair-order.md which conditions hold, from the orders in their certificates;
where weights are negative it does not.
"""

from __future__ import annotations

import argparse
import random
import re
import shutil
import signal
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from os import cpu_count
from pathlib import Path

from garkcli import catalogue, certificate, load, loads
from garkcli.errors import GarkError
from tests.bridges.machine import NotHad, Tool, need
from tests.order.test_pair_order import QUARTERS, THREE_EIGHTHS

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / ".proofs"
STEPS = (
    *("Stages", "Trees", "Methods", "Sums", "Check", "Pairs", "Products", "Conditions"),
    *("Sufficient", "Definite", "Weights", "Positive", "Lemma0", "PairOrder"),
)
COQ = Tool("Coq", ("coqc", "--version"), "coq")
LONGEST = 300  # seconds of processor time for a file
MUTANTS = 200
MUTATED = ("rk4", "gauss-2", "tr-bdf2", "methods/collocation.gark.yaml")
NO_AXIOMS = "Closed under the global context"
LOBATTO = "{A: [[0, 0, 0], [5/24, 1/3, -1/24], [1/6, 2/3, 1/6]], b: [1/6, 2/3, 1/6]}"
GAUSS_2 = (
    "{A: [[1/4, 1/4 - sqrt(3)/6], [1/4 + sqrt(3)/6, 1/4]], b: [1/2, 1/2], "
    "c: [1/2 - sqrt(3)/6, 1/2 + sqrt(3)/6]}"
)
PAIRS = (  # two methods, a transfer, the order of the pair
    (LOBATTO, QUARTERS, "collocation", 4),
    (THREE_EIGHTHS, LOBATTO, "interpolation", 3),
    (LOBATTO, THREE_EIGHTHS, "{rule: legendre, degree: 4}", 2),
    (THREE_EIGHTHS, "{family: gauss, stages: 3}", "symplectic-collocation", 2),  # in ℚ[x]/(M)
    (LOBATTO, GAUSS_2, "collocation", 4),  # over ℚ(√3)
)
CRITERION = """
From Gark Require Import Conditions PairOrder.
Theorem the_criterion : criterion the_method (row_sums the_method) {k} {order}.
Proof.
  apply (theorem_B_for the_method the_conjugate [1] {k} {order});
    [vm_compute; reflexivity|exact it_is_the_conjugate|auto|exact order_of_pair].
Qed.
Print Assumptions the_criterion.

Theorem not_one_higher : ~ criterion the_method (row_sums the_method) {next_k} {next}.
Proof.
  intros H. apply pair_has_no_higher_order.
  apply (theorem_B_for the_method the_conjugate [1] {next_k} {next});
    [vm_compute; reflexivity|exact it_is_the_conjugate|auto|exact H].
Qed.
Print Assumptions not_one_higher.
"""
NEGATIVE = (("negative-weights", 3), ("negative-weights-order4", 4))
SIGNS_MATTER = """
From Gark Require Import Conditions PairOrder.
Theorem signs_matter : has_order the_pair {order} /\\ ~ criterion the_method (row_sums the_method) 1 {order}.
Proof.
  split; [exact order_of_pair|]. intros [_ [CD _]].
  assert (first : (0 < N the_method)%nat) by (vm_compute; auto).
  destruct (CD 0%nat 0%nat first first ltac:(discriminate)) as [_ D1].
  assert (E := D1 1%nat (unit 0) 0%nat ltac:(auto) ltac:(vm_compute; auto)).
  vm_compute in E. discriminate E.
Qed.
Print Assumptions signs_matter.
"""


def coqc(name: str) -> subprocess.CompletedProcess[str]:
    """Compile a file in the folder of the build."""
    command = f"ulimit -S -t {LONGEST}; exec coqc -q -noglob -R . Gark {name}.v"
    return subprocess.run(
        ["sh", "-c", command], cwd=BUILD, capture_output=True, text=True, check=False
    )


def told(name: str, text: str) -> tuple[str, str]:
    """What Coq says of a file: "proved", "refused" with its words, or "too long"."""
    (BUILD / f"{name}.v").write_text(text, encoding="utf-8")
    done = coqc(name)
    if done.returncode == -signal.SIGXCPU:
        return "too long", f"more than {LONGEST} s"
    asked = text.count("\nPrint Assumptions ")
    if done.returncode or done.stdout.count(NO_AXIOMS) != asked:
        return "refused", done.stderr or done.stdout
    return "proved", f"{text.count(chr(10) + 'Theorem ')} theorems"


def judged(number: int, source: str) -> tuple[str, str]:
    """What Coq says of a method, or why there is no file."""
    try:
        text = certificate(load(source), format="coq")
    except GarkError as error:
        return "left out", error.message
    return told(f"method{number}", text)


def reasoned(number: int, first: str, second: str, transfer: str, order: int) -> tuple[str, str]:
    """What Coq says of Theorem B, used on a pair of that order."""
    method = loads(f"methods: [{first}, {second}]\ntransfer: {transfer}")
    why = CRITERION.format(k=(order - 1) // 2, order=order, next_k=order // 2, next=order + 1)
    return told(f"pair{number}", certificate(method, format="coq") + why)


def signs_matter(number: int, name: str, order: int) -> tuple[str, str]:
    """What Coq says of a method with a negative weight whose pair has that order without D(1)."""
    method = load(ROOT / "tests" / "examples" / "valid" / f"{name}.gark.yaml")
    text = certificate(method, format="coq") + SIGNS_MATTER.format(order=order)
    return told(f"signs{number}", text)


def mutant_file(text: str, rng: random.Random, count: int) -> str:
    """A file that compiles when Coq refuses each of so many files with one number changed."""
    head, body = text.split("Open Scope Q_scope.\n", 1)
    data = re.sub(r"Theorem .*?Qed\.\n|Definition all_theorems.*", "", body, flags=re.DOTALL)
    checks = ["conjugate_is_proved the_method the_conjugate"]
    for name, order, label in re.findall(
        r"has_order (\w+) (\d+)\.\nProof\.\n  apply has_order_by with \(F := (\w+)_trees\)", body
    ):
        checks.append(f"order_is_proved {name} {order} {label}_trees {label}_branches")
    whole = " && ".join(f"({check})" for check in checks)
    # numbers in lists; the pivots, which are of nat, and names are not among them, nor is a
    # polynomial of degree one, whose root is a rational number whatever it is
    numbers = re.finditer(r"(?<!field := \[)(?<=[\[ (])-?\d+(?=[];)#])", data)
    places = [m.span() for m in numbers]
    parts = [head.replace("List.", "List Bool.") + "Open Scope Q_scope.\n"]
    chosen = [None, *rng.sample(places, min(count, len(places)))]
    for number, place in enumerate(chosen):
        changed = data
        if place is not None:
            start, end = place
            changed = f"{data[:start]}{int(data[start:end]) + 1}{data[end:]}"
        tactic = "vm_compute; reflexivity"
        judge = f"{tactic}." if place is None else f"Fail ({tactic}). vm_compute."
        end_of = "Qed." if place is None else "Abort."
        parts.append(
            f"Module M{number}.\n{changed}\n"
            f"Lemma all : ({whole})%bool = true.\nProof. {judge} {end_of}\nEnd M{number}.\n"
        )
    return "\n".join(parts)


def main() -> int:
    """Run; the exit code is 1 where Coq refuses a method or takes a changed file, 2 without Coq."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="", help="methods whose name has this in it")
    only = parser.parse_args().only
    try:
        need(COQ)
    except NotHad as missing:
        print(f"not run: {missing}", file=sys.stderr)
        return 2
    shutil.rmtree(BUILD, ignore_errors=True)
    BUILD.mkdir()
    for step in STEPS:
        verdict, why = told(step, (ROOT / "proofs" / f"{step}.v").read_text(encoding="utf-8"))
        if verdict != "proved":
            print(f"{verdict:9} proofs/{step}.v: {why}", file=sys.stderr)
            return 1
    bad = 0
    for number, (first, second, transfer, order) in enumerate(PAIRS):
        verdict, why = reasoned(number, first, second, transfer, order)
        print(f"{verdict:9} why a pair has order {order}: {why.splitlines()[0]}", flush=True)
        bad += verdict != "proved"
    for number, (name, order) in enumerate(NEGATIVE):
        verdict, why = signs_matter(number, name, order)
        print(f"{verdict:9} order {order} without D(1): {why.splitlines()[0]}", flush=True)
        bad += verdict != "proved"
    files = sorted(str(p) for p in (ROOT / "methods").rglob("*.gark.yaml"))
    sources = [x for x in [*files, *catalogue] if only in x]
    verdicts: Counter[str] = Counter()
    with ThreadPoolExecutor(cpu_count()) as pool:
        for source, (verdict, why) in zip(
            sources, pool.map(judged, range(len(sources)), sources), strict=True
        ):
            print(
                f"{verdict:9} {source.removeprefix(str(ROOT) + '/')}: {why.splitlines()[0]}",
                flush=True,
            )
            verdicts[verdict] += 1
    print(f"{len(sources)} methods:", ", ".join(f"{n} {x}" for x, n in verdicts.most_common()))
    bad += verdicts["refused"]
    rng = random.Random(1)
    taken = 0
    for number, source in enumerate(x for x in MUTATED if only in x):
        text = certificate(load(str(ROOT / source) if "/" in source else source), format="coq")
        mutants = mutant_file(text, rng, MUTANTS // len(MUTATED))
        (BUILD / f"mutants{number}.v").write_text(mutants, encoding="utf-8")
        done = coqc(f"mutants{number}")
        count = mutants.count("Fail (")
        print(f"{'taken' if done.returncode else 'refused':9} {count} files made of {source}")
        if done.returncode:
            print(done.stderr, file=sys.stderr)
            taken += 1
    return 1 if bad or taken else 0


if __name__ == "__main__":
    sys.exit(main())
