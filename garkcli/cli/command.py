"""The commands of click, made of the declared options, with their help in groups."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar, cast

import click

from garkcli.cli import arguments
from garkcli.cli import options as opt
from garkcli.cli.options import CATALOGUE, METHOD, REPORTED, Bundle, Options, declared_by, rules_of
from garkcli.cli.output import Output
from garkcli.cli.streams import put_help
from garkcli.cli.table import COMMANDS
from garkcli.frozen import Frozen, replace

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile

Given = TypeVar("Given", bound=Options)
Body: TypeAlias = Callable[[Given, Output], "int | None"]
CONTEXT = {
    "help_option_names": [],
    "max_content_width": 100,
    "token_normalize_func": arguments.spelled,
}
ONE_METHOD = (
    "a method file, a name of the catalogue such as rk4, a family with its stages such as gauss-3, "
    "or - for standard input"
)
SEVERAL = (
    "a directory stands for all *.gark.yaml below it, a pattern (in quotes, ** for any "
    "directories) for the files that match"
)


class Declared(Frozen, Generic[Given]):
    name: str
    options: type[Given]
    formats: Sequence[str]
    output: Mapping[str, opt.Option]
    has_catalogue: bool
    body: Callable[[Given, Output], int | None]

    @property
    def methods(self) -> list[opt.Option]:
        return [x for x in self._own if x.is_argument and x.kind.settings.get("type") is _METHODS]

    @property
    def all_options(self) -> list[opt.Option]:
        catalogue = [_CATALOGUE] if self.has_catalogue or self.methods else []
        return [*self._own, *catalogue, *self.output.values()]

    @property
    def _own(self) -> list[opt.Option]:
        found = declared_by(self.options).values()
        return [x for each in found if isinstance(each, tuple) for x in each]

    def made(self) -> click.Command:
        return GroupedCommand(
            self.name,
            COMMANDS[self.name].examples,
            callback=self._run,
            params=[*self._params(), help_option()],
            help=self._help(),
            context_settings=CONTEXT,
        )

    def _params(self) -> Iterator[click.Parameter]:
        inherited = {x for base in self.options.__bases__ for x in declared_by(base)}
        made: dict[str, list[click.Parameter]] = {}
        heading = "Options"
        for name, declared in declared_by(self.options).items():
            if isinstance(declared, Bundle):
                made[name] = [*declared.make()]
                continue
            for each in declared:
                heading = each.heading or heading
                made.setdefault(name, []).append(_parameter(each, name, heading))
        own = sorted(made, key=lambda name: name in inherited)
        yield from (x for name in own for x in made[name])
        if self.has_catalogue or self.methods:
            yield _parameter(_CATALOGUE, "catalogue", METHOD_HEADING)
        for name, each in self.output.items():
            if name == "format":
                kind: opt.Kind[str] = opt.Kind(
                    {"type": click.Choice(self.formats), "default": self.formats[0]}
                )
                each = replace(each, kind=kind, is_former=len(self.formats) == 1)
            if name == "output" and len(self.formats) == 1:
                each = replace(each, help="Write the result to FILE; - is standard output.")
            yield _parameter(each, name, OUTPUT_HEADING)

    def _run(self, **values: Any) -> int | None:
        output = Output.of({name: values.pop(name) for name in self.output}, self.formats)
        for name, declared in declared_by(self.options).items():
            if isinstance(declared, Bundle):
                values[name] = {str(x.name): values.pop(str(x.name)) for x in declared.make()}
        given = self.options(**values)
        self._check(given, output)
        if self.name == "check" or not self.methods:
            return self.body(given, output)
        from garkcli.methodfile.load import noting

        with noting() as read:
            code = self.body(given, output)
        hint_rounding(read, output)
        return code

    def _check(self, given: Given, output: Output) -> None:
        told = {"format": output.format, "output": output.path, "verbose": output.verbosity > 0}
        values = [(x, told[name]) for name, x in self.output.items() if name in told]
        for name, declared in declared_by(self.options).items():
            if isinstance(declared, tuple):
                values += [(x, getattr(given, name)) for x in declared]

        def value_of(option: opt.Option) -> object:
            return next(value for x, value in values if x is option)

        for rule in rules_of(self.options):
            rule.check(value_of)

    def _help(self) -> str:
        text = inspect.getdoc(self.body) or ""
        methods = self.methods
        if not methods:
            return text
        names = " and ".join(x.key for x in methods)
        meant = f"{names} {'is' if len(methods) == 1 else 'are each'} {ONE_METHOD}"
        if any(x.kind.settings.get("nargs") == -1 for x in methods):
            meant += f"; {SEVERAL}"
        first, *rest = text.split("\n\n")
        return "\n\n".join([first, f"{meant}.", *rest])


_METHODS = METHOD.settings["type"]
_CATALOGUE = cast("opt.Option", CATALOGUE)
OUTPUT_HEADING, METHOD_HEADING = "Output", "Method"


class GroupedCommand(click.Command):
    """The help begins with lines to copy and has options below headings."""

    def __init__(self, name: str, examples: Sequence[str], **settings: Any) -> None:
        self.examples = examples
        super().__init__(name, **settings)

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        formatter.write_paragraph()
        formatter.indent()
        for line in self.examples:
            formatter.write_text(line)
        formatter.dedent()
        super().format_help_text(ctx, formatter)

    def groups(self, ctx: click.Context) -> dict[str, list[tuple[str, str]]]:
        """Options with their help, by headings; those on the output are last."""
        groups: dict[str, list[tuple[str, str]]] = {}
        for param in self.get_params(ctx):
            if isinstance(param, GroupedOption) and (record := param.get_help_record(ctx)):
                groups.setdefault(param.heading, []).append(record)
        return groups | {OUTPUT_HEADING: groups.pop(OUTPUT_HEADING)}

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        for heading, records in self.groups(ctx).items():
            with formatter.section(heading):
                told = [x for x in records if x[1]]
                if told:
                    formatter.write_dl(told)
                names = [_in_short(name) for name, text in records if not text]
                if names:
                    formatter.write_text(", ".join(names))


def _in_short(name: str) -> str:
    """A switch as one flag.

    >>> _in_short("--l-stable / --no-l-stable")
    '--[no-]l-stable'
    """
    yes, _, no = name.partition(" / ")
    return f"--[no-]{yes[2:]}" if no else name


class GroupedOption(click.Option):
    """The help and the default may be those of an argument of a function of the package, looked up
    only for the help; if the option is not given, the argument is not passed.
    """

    def __init__(self, flags: list[str], heading: str, of: str = "", **settings: Any) -> None:
        self.heading = heading
        self._of = of
        self._help: str | None = None
        self._has_default = not of or "default" in settings or bool(settings.get("required"))
        super().__init__(flags, **settings)

    @property
    def help(self) -> str | None:
        return self._help or (told(self._of) if self._of else None)

    @help.setter
    def help(self, text: str | None) -> None:
        self._help = text

    def get_default(self, ctx: click.Context, call: bool = True) -> Any:
        """The default of the argument for the help, unless the command has its own."""
        if self._has_default:
            return super().get_default(ctx, call)
        default = None if call else parameter_of(self._of).default
        # an empty text is not worth a word of help
        return None if default in (inspect.Parameter.empty, "") else default


def _parameter(option: opt.Option, name: str, heading: str) -> click.Parameter:
    settings = {**option.kind.settings}
    if option.kind.choices:
        settings["type"] = click.Choice([*arguments.named(option.kind.choices)])
    if option.is_argument:
        return click.Argument([name], **{**settings, "metavar": option.flags[0]})
    is_of_argument = bool(option.of) and "default" not in settings
    settings["show_default"] = is_of_argument or settings.get("default") is not None
    return GroupedOption(
        [*option.flags, name],
        heading,
        option.of,
        help=option.help or None,
        hidden=option.is_former,
        **settings,
    )


def parameter_of(of: str) -> inspect.Parameter:
    """``function.argument`` of the package."""
    function, _, name = of.partition(".")
    return inspect.signature(getattr(import_module("garkcli"), function)).parameters[name]


def told(of: str) -> str:
    """The text about an argument in the docstring of a function."""
    function, _, name = of.partition(".")
    lines = iter((inspect.getdoc(getattr(import_module("garkcli"), function)) or "").splitlines())
    found = ""
    for line in lines:
        if found and not line.startswith("        "):
            break
        if found or line.startswith(f"    {name}: "):
            found = f"{found} {line.strip()}".strip()
    text = found.removeprefix(f"{name}: ").replace("``", "")
    return text[:1].upper() + text[1:]


def _show_help(context: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted and not context.resilient_parsing:
        put_help(context.get_help() + "\n")
        context.exit()


def help_option() -> click.Option:
    return GroupedOption(
        ["-h", "--help"],
        OUTPUT_HEADING,
        is_flag=True,
        is_eager=True,
        expose_value=False,
        callback=_show_help,
        help="Show this message and exit.",
    )


_DECLARED: dict[str, Declared[Any]] = {}


def declared(
    name: str,
    options: type[Given],
    formats: Sequence[str] = (),
    output: Mapping[str, object] = REPORTED,
    has_catalogue: bool = False,
) -> Callable[[Body[Given]], Body[Given]]:
    """The function implements a command: it takes options and ``Output``, and returns the exit
    code, or None for 0. ``formats`` are those it writes, the first by default; ``output`` its
    options on them.
    """

    def declare(body: Body[Given]) -> Body[Given]:
        told = cast("Mapping[str, opt.Option]", output)
        _DECLARED[name] = Declared(name, options, formats, told, has_catalogue, body)
        return body

    return declare


def declaration_of(name: str) -> Declared[Any]:
    import_module(f"garkcli.cli.{COMMANDS[name].file}")
    return _DECLARED[name]


@cache
def command_of(name: str) -> click.Command:
    return declaration_of(name).made()


def hint_rounding(methods: Iterable[MethodFile], output: Output) -> None:
    """Notes methods whose coefficients look rounded, with the missing line: as slow as a check."""
    if output.verbosity < 0:
        return
    from garkcli.check.analysis import looks_rounded

    several = len({method.source for method in methods}) > 1
    said = []
    for method in methods:
        found = looks_rounded(method)
        if found is not None:
            where = f"{method.source}: " if several else ""
            said.append(
                f"{where}hint: the coefficients look rounded; with the line  {found.line}  "
                f"order {found.order} holds"
            )
    for text in dict.fromkeys(said):
        output.note(text)
