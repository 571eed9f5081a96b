"""What goes wrong with a driven lens is named, costs no accuracy, and leaves the camera well."""

from dataclasses import replace

import numpy as np
import pytest
from webcam_rig import moving, still, task

from tagmetry.camera import CameraBank
from tagmetry.camera.controls import ControlMisreadError, ControlRefusedError, ControlStuckError
from tagmetry.errors import ControlError
from tagmetry.pipeline.lens import LensStep, measure_marker
from tagmetry.twin.camera import (
    BeforeCamera,
    Faults,
    TwinCamera,
    facing_camera,
    markers_before_camera,
    webcam,
)
from tagmetry.twin.scenes import Light, Scene, Still

ENOUGH = 200  # images; whatever takes more hangs


def run(camera: TwinCamera, **changes) -> list[LensStep]:
    """All steps of a measurement that ends."""
    steps = []
    for step in measure_marker(camera, task(**changes)):
        steps.append(step)
        assert len(steps) < ENOUGH
    return steps


def values(camera: TwinCamera) -> dict[str, float]:
    return {name: camera.controls.read(name) for name in camera.controls.available}


@pytest.mark.parametrize(
    ("faults", "kind", "words"),
    [
        (Faults(refused=frozenset({"zoom"})), ControlRefusedError, "zoom"),
        (Faults(refused=frozenset({"focus"})), ControlRefusedError, "focus"),
        (Faults(refused=frozenset({"auto_focus"})), ControlRefusedError, "auto_focus"),
        (Faults(stuck=frozenset({"zoom"})), ControlStuckError, r"zoom: from .* marker grew 1\.0"),
        (Faults(stuck=frozenset({"focus"})), ControlStuckError, r"focus: at .* blurred by"),
        (Faults(misread={"zoom": 7.0}), ControlMisreadError, "zoom: .* reads back"),
        (Faults(misread={"focus": -4.0}), ControlMisreadError, "focus: .*; not set back as it was"),
    ],
)
def test_a_control_that_fails_is_named(
    faults: Faults, kind: type[ControlError], words: str
) -> None:
    camera = still(0.1, faults=faults)
    before = values(camera)
    with pytest.raises(kind, match=words):
        run(camera)
    broken = faults.refused | set(faults.misread)  # of which nobody can say where they are
    assert values(camera).items() - before.items() <= {(n, values(camera)[n]) for n in broken}


@pytest.mark.parametrize("late", [{"zoom": 3, "focus": 3}, {"zoom": 6}, {"zoom": 10}, {"focus": 6}])
def test_a_control_that_is_late_costs_images_but_no_accuracy(late: dict[str, int]) -> None:
    camera = still(0.1, faults=Faults(late_images=late))
    before = values(camera)
    last = run(camera)[-1]
    assert values(camera) == before
    assert last.is_final
    assert last.found.depth_m == pytest.approx(0.1, rel=3e-3)


def test_two_equal_ids_are_named_and_not_measured() -> None:
    scene = markers_before_camera(
        *(BeforeCamera(Still(facing_camera(0.3, 20.0, x_m))) for x_m in (-0.015, 0.015))
    )
    steps = run(TwinCamera(scene, webcam(), quick=True), most_images=8, marker_id=7)
    assert all(step.found is None for step in steps)
    assert steps[-1].reason.startswith("id 7 is there more than once")
    assert steps[-1].reason.endswith("given up after 8 images")


def test_a_marker_that_leaves_for_good_ends_the_measurement_with_the_reason() -> None:
    camera = moving([0.0, 0.1, 0.11, 9.0], [0.4, 0.4, 0.4, 0.4], [0.0, 0.0, 5.0, 5.0])
    steps = run(camera, most_images=8)
    assert any(step.found is not None for step in steps)
    assert steps[-1].found is None
    assert "no marker in 8 images" in steps[-1].reason


def test_a_bank_with_holes_is_interpolated_and_the_hole_counts() -> None:
    whole = task().lens
    holed = replace(
        whole,
        bank=CameraBank(
            tuple(node for node in whole.bank.nodes if not 60 < node.focus < 120),
            zoom_is_digital=True,
        ),
    )
    assert max(gap.high_focus - gap.low_focus for gap in holed.gaps) > 50
    last = run(still(0.15), lens=holed)[-1]
    assert last.is_final
    assert abs(last.found.depth_m / 0.15 - 1) < 3e-3
    assert abs(last.found.depth_m - 0.15) < 3 * last.found.depth_sd_m


@pytest.mark.slow
def test_in_backlight_another_exposure_finds_the_marker() -> None:
    there = markers_before_camera(BeforeCamera(Still(facing_camera(0.3, 30.0)))).things
    backlit = Scene(there, Light(ambient=0.02), background=3.0)
    camera = TwinCamera(backlit, webcam(), quick=True)
    for _ in range(12):
        camera.take()  # its own automatic sees the window, not the marker
    dark_s = camera.controls.read("exposure")
    steps = run(camera)
    found = next(step for step in steps if step.found is not None)
    assert found.image.sequence - steps[0].image.sequence > 3  # not in the first pass
    assert steps[-1].is_final
    assert steps[-1].found.depth_m == pytest.approx(0.3, rel=3e-3)
    assert dark_s < 0.016
    assert np.percentile(found.image.pixels, 90) > 250  # the window is far too bright for that
