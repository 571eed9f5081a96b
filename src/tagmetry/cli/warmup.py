"""`tagmetry warmup`: compile for this machine now, so that nothing has to wait for it later."""

import sys
import time

import typer

from tagmetry.cli.kernels import cache_folder, compile_time_s, is_kept, kept_count, kernels


def warmup() -> None:
    """Compile every fast loop for this machine, once; later runs start at once."""
    began_s = time.monotonic()
    from tagmetry.cli.progress import counted
    from tagmetry.pipeline.warmup import steps, warmed

    before = kept_count(kernels())
    for _ in counted(warmed(), len(steps()), "compiling for this machine"):
        pass
    some = kernels()
    new, took_s = kept_count(some) - before, time.monotonic() - began_s
    if not is_kept():
        typer.echo(
            "tagmetry: no folder to keep compiled code in can be written, so every run compiles "
            "anew; set NUMBA_CACHE_DIR to one that can",
            err=True,
        )
        return
    state = f"{new} kernels compiled" if new else f"{len(some)} kernels were ready"
    typer.echo(f"{state}, {took_s:.0f} s; kept in {cache_folder(some)}")


def tell_compiling() -> None:
    """Say to a person who watches that the first image will take a while, where it will."""
    if sys.stderr.isatty() and (wait_s := compile_time_s("tagmetry.detect")):
        typer.echo(
            f"tagmetry: compiling for this machine, once: about {max(wait_s, 1):.0f} s", err=True
        )
