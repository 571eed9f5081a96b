"""The `tagmetry` command: gathers the subcommands and turns known errors into one line.

Exit codes: 0 done, 1 a fault of the program, 2 an input that cannot be used, 130 interrupted.
"""

import io
import os
import sys
import warnings

import typer
from typer.exceptions import TyperException

from tagmetry import __version__
from tagmetry.cli.arena import app as arena_app
from tagmetry.cli.bench import bench
from tagmetry.cli.calibrate import calibrate
from tagmetry.cli.camera import app as camera_app
from tagmetry.cli.compare import compare
from tagmetry.cli.demo import demo
from tagmetry.cli.detect import detect
from tagmetry.cli.doctor import doctor
from tagmetry.cli.info import info
from tagmetry.cli.kernels import ensure_cache_folder
from tagmetry.cli.lab import app as lab_app
from tagmetry.cli.lens import app as lens_app
from tagmetry.cli.live import live
from tagmetry.cli.locate import locate
from tagmetry.cli.plain_help import with_plain_names
from tagmetry.cli.plan import plan
from tagmetry.cli.print import app as print_app
from tagmetry.cli.twin import app as twin_app
from tagmetry.cli.warmup import warmup
from tagmetry.errors import InputError

app = typer.Typer(
    help="Turn any camera into a measuring instrument with printed markers.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.command()(detect)
app.command()(calibrate)
app.command()(locate)
app.command()(plan)
app.add_typer(arena_app, name="arena")
app.command()(live)
app.command()(compare)
app.add_typer(print_app, name="print")
app.add_typer(camera_app, name="camera")
app.add_typer(twin_app, name="twin")
app.add_typer(lens_app, name="lens")
app.add_typer(lab_app, name="lab")
app.command()(info)
app.command()(doctor)
app.command()(demo)
app.command()(warmup)
app.command()(bench)


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"tagmetry {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: bool = typer.Option(
        False, "--version", callback=_print_version, is_eager=True, help="Print the version."
    ),
) -> None:
    """Gather the subcommands."""


def main() -> None:
    """Run the command line and exit with its code."""
    warnings.showwarning = _warn
    if isinstance(sys.stdout, io.TextIOWrapper):  # file names and units may not fit its encoding
        sys.stdout.reconfigure(errors="backslashreplace")
    sys.exit(run(sys.argv[1:]))


def run(arguments: list[str]) -> int:
    """Run one command and return its exit code."""
    try:
        _invoke(arguments)
        sys.stdout.flush()
    except typer.Exit as done:
        return done.exit_code
    except (TyperException, InputError) as error:
        return _refuse(error.format_message() if isinstance(error, TyperException) else str(error))
    except OSError as error:
        return _refuse_os(error)
    except SystemExit as exit_:
        if not isinstance(exit_.__context__, BrokenPipeError):
            raise
        return 0  # how rich leaves when nobody reads the help
    except (KeyboardInterrupt, typer.Abort):
        sys.stderr.write("tagmetry: interrupted\n")
        return 130
    return 0


def _warn(message: Warning | str, *_: object, **__: object) -> None:
    """Say a warning as any other word to the person: without the file and line that had it."""
    sys.stderr.write(f"tagmetry: {' '.join(str(message).split())}\n")


def _invoke(arguments: list[str]) -> None:
    """Run one command; Typer's own runner would turn a closed pipe and Ctrl-C into exits."""
    ensure_cache_folder()
    command = with_plain_names(typer.main.get_command(app))
    with command.make_context("tagmetry", list(arguments)) as context:
        try:
            command.invoke(context)
        except SystemError as error:  # how a compiled loop hands Ctrl-C on
            if _has_interrupt(error):
                raise KeyboardInterrupt from error
            raise


def _has_interrupt(error: BaseException | None) -> bool:
    """Say whether Ctrl-C is among what led to an error: each loop on the way wraps it anew."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _refuse_os(error: OSError) -> int:
    """Say what the system refused; a reader that went away (a closed pipe) is no error."""
    if isinstance(error, BrokenPipeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    where = f"{error.filename}: " if error.filename else ""
    return _refuse(f"{where}{error.strerror or error}")


def _refuse(text: str) -> int:
    """Say why on one line; where the help was shown instead there is nothing to say."""
    line = " ".join(text.split())
    if line:
        sys.stderr.write(f"tagmetry: {line}\n")
    return 2
