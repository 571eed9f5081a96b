"""A controller: leave those that are nearer than 0.45 m; docs/clients/spread.c does the same."""

from tagmetry.arena.controllers import Disperse

control = Disperse(0.45)
