"""A controller: leave those that are nearer than 0.8 m; docs/clients/spread.c does the same."""

from tagmetry.arena.controllers import Disperse

control = Disperse(0.8)
