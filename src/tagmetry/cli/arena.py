"""`tagmetry arena`: robots under a ceiling camera."""

import typer

from tagmetry.cli.arena_audit import audit
from tagmetry.cli.arena_calibrate import calibrate
from tagmetry.cli.arena_client import client, key
from tagmetry.cli.arena_latency import latency
from tagmetry.cli.arena_mount import mount
from tagmetry.cli.arena_recording import export, replay
from tagmetry.cli.arena_run import run
from tagmetry.cli.arena_stability import stability
from tagmetry.cli.arena_twin import twin
from tagmetry.cli.arena_watch import watch

app = typer.Typer(help="Robots under a ceiling camera.", no_args_is_help=True)
app.command()(calibrate)
app.command()(audit)
app.command()(mount)
app.command()(run)
app.command()(twin)
app.command()(watch)
app.command()(replay)
app.command()(export)
app.command()(client)
app.command()(key)
app.command()(latency)
app.command()(stability)
