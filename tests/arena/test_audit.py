"""Error maps of grids of markers."""

import numpy as np
import pytest
from overhead import VIEW, detected, moved

from tagmetry.arena import AuditGrid, GridPlace, OverheadView, audit
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation

GRID = AuditGrid(6, 4, 0.2, 0.1, first_id=30)
PLACE = GridPlace(0.1, -0.05, 0.3)


def picture(view: OverheadView = VIEW, rng: np.random.Generator | None = None) -> list[Detection]:
    T_world_grid = RigidTransform.from_components(
        [PLACE.x_m, PLACE.y_m, 0.0], Rotation.from_euler("z", PLACE.turn_rad)
    )
    x = 0.2 * (np.arange(6) - 2.5)
    y = 0.2 * (1.5 - np.arange(4))
    centers = [(a, b) for b in y for a in x]
    return [
        detected(
            "tag36h11",
            30 + n,
            0.1,
            T_world_grid * RigidTransform.from_translation([*at, 0]),
            view,
            rng,
        )
        for n, at in enumerate(centers)
    ]


@pytest.mark.parametrize("place", [PLACE, None], ids=["known place", "best place"])
def test_no_error_where_all_is_right(place: GridPlace | None) -> None:
    found = audit(picture(), GRID, VIEW, place)
    assert found.worst_m < 1e-8
    assert (found.place.x_m, found.place.y_m) == pytest.approx((0.1, -0.05))
    assert found.place.turn_rad == pytest.approx(0.3)
    assert found.missing == ()
    assert len(found.ids) == GRID.count == 24


def test_stated_deviations_are_the_errors() -> None:
    rng = np.random.default_rng(0)
    sds = np.array([1e-3, 1e-3, 1e-3, 4e-4, 4e-4, 4e-4])
    stated = OverheadView(VIEW.camera, VIEW.T_world_camera, np.diag(sds**2))
    ratios = []
    for _ in range(60):
        seen = picture(moved(stated, sds * rng.standard_normal(6)), rng)
        found = audit(seen, GRID, stated, PLACE)
        ratios.append((found.radial_m**2 / found.sd_m**2).mean())
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.25)


def test_a_shift_shows_only_where_the_place_is_known() -> None:
    off = moved(VIEW, np.array([0.01, 0, 0, 0, 0, 0]))
    assert audit(picture(off), GRID, VIEW, PLACE).rms_m == pytest.approx(0.01, rel=1e-3)
    assert audit(picture(off), GRID, VIEW).rms_m < 1e-6


def test_markers_that_are_not_seen_are_named_and_several_images_averaged() -> None:
    rng = np.random.default_rng(1)
    once = audit(picture(rng=rng)[2:], GRID, VIEW, PLACE)
    often = audit([d for _ in range(25) for d in picture(rng=rng)], GRID, VIEW, PLACE)
    assert once.missing == (30, 31)
    assert often.rms_m < 0.35 * once.rms_m


def test_the_error_below_the_camera_is_of_the_markers_there() -> None:
    found = audit(picture(moved(VIEW, np.array([0.01, 0, 0, 0, 0, 0]))), GRID, VIEW, PLACE)
    assert found.below_camera_m(0.3) == pytest.approx(0.01, rel=1e-2)
    assert np.isnan(found.below_camera_m(1e-6))


def test_refuses_grids_that_cannot_be() -> None:
    with pytest.raises(InputError, match="columns and rows"):
        AuditGrid(0, 4, 0.2, 0.1)
    with pytest.raises(InputError, match="size below the step"):
        AuditGrid(3, 4, 0.1, 0.2)
    with pytest.raises(InputError, match="2 of 24 are seen; check the family"):
        audit(picture()[:2], GRID, VIEW)
