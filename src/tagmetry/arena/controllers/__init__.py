"""Controllers: what a robot does with what it knows; the same on the twin and on real robots."""

from tagmetry.arena.controllers.course import Arc, Course, Reference, line_loop_line
from tagmetry.arena.controllers.formation import Formation
from tagmetry.arena.controllers.leader_follower import Spring, SpringFollower
from tagmetry.arena.controllers.manner import Manner
from tagmetry.arena.controllers.parameters import Parameter, Tunable, parameters_of, tuned
from tagmetry.arena.controllers.patient import PatientFollower
from tagmetry.arena.controllers.shield import Shielded, ShieldRules
from tagmetry.arena.controllers.swarm import Aggregate, Disperse
from tagmetry.arena.controllers.tracking import Gains, PathFollower
from tagmetry.arena.controllers.view import Controller, View
from tagmetry.arena.controllers.wander import Wander
from tagmetry.arena.controllers.waypoints import legs_through

__all__ = [
    "Aggregate",
    "Arc",
    "Controller",
    "Course",
    "Disperse",
    "Formation",
    "Gains",
    "Manner",
    "Parameter",
    "PathFollower",
    "PatientFollower",
    "Reference",
    "ShieldRules",
    "Shielded",
    "Spring",
    "SpringFollower",
    "Tunable",
    "View",
    "Wander",
    "legs_through",
    "line_loop_line",
    "parameters_of",
    "tuned",
]
