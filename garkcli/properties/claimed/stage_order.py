"""The stage order."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    found = subject.stage_orders
    least = min(found)
    names = [colour.name for colour in subject.tableau.colours]
    by_colour = [
        f"{'at least ' if q >= subject.limit else ''}{q} of {name}"
        for q, name in zip(found, names, strict=True)
    ]
    why = f"by colour: {', '.join(by_colour)}" if len(found) > 1 else ""
    return Verdict(least, why, is_at_least=least >= subject.limit)


PROPERTY = Property(
    key="stage-order",
    text=(
        "The largest q for which B^{l}(q) and C^{l,m}(q) hold for all l and m whose block exists:"
        " quadrature and stage values of the same order q. Of one colour l: for that l and all m."
        " The nodes are those that the file gives."
    ),
    source="E. Hairer, G. Wanner, Solving ODEs II, section IV.15",
    kind="count",
    decide=_decide,
)
