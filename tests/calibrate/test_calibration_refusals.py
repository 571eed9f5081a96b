"""Views that determine no camera are refused in one line, never answered with a wild camera."""

from dataclasses import replace

import numpy as np
import pytest
from seen_boards import FISHEYE, NARROW, USUAL, WIDE, board_points, seen, view_of

from tagmetry.calibrate.view import BoardView
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.errors import InputError


def some(count: int = 6, seed: int = 0, **kind: object) -> list[BoardView]:
    return seen(USUAL, count, np.random.default_rng(seed), **kind)


def only(view: BoardView, chosen: np.ndarray) -> BoardView:
    """Return a view of some of the points."""
    return replace(
        view,
        points=view.points[chosen],
        p_board=view.p_board[chosen],
        corners_px=view.corners_px[chosen],
        covariances_px2=view.covariances_px2[chosen],
    )


def moved(view: BoardView, right_px: float) -> BoardView:
    return replace(view, corners_px=view.corners_px + np.array([right_px, 0.0]))


def mirrored(view: BoardView) -> BoardView:
    rows = np.arange(54).reshape(6, 9)[:, ::-1].ravel()
    return replace(view, corners_px=view.corners_px[rows])


@pytest.mark.parametrize("count", [0, 1, 2])
def test_few_views(count: int) -> None:
    with pytest.raises(InputError, match=f"expected at least 3 views .* got {count} that can"):
        calibrate(some(count), "brown4")


def test_names_that_do_not_exist() -> None:
    with pytest.raises(InputError, match=r"expected a lens of none, brown1.* or auto, got 'plumb'"):
        calibrate(some(3), "plumb")
    with pytest.raises(InputError, match="expected a shape of flat or free, got 'bent'"):
        calibrate(some(3), "brown4", shape="bent")


def test_mixed_sizes() -> None:
    views = some()
    with pytest.raises(InputError, match=r"pictures of one size, got 1280x960 .* and 2000x960"):
        calibrate([*views[:3], replace(views[3], width_px=2000)], "brown4")


def test_boards_that_disagree() -> None:
    views = some()
    other = replace(views[3], p_board=views[3].p_board * 2)
    with pytest.raises(InputError, match="view 3 puts the board's points elsewhere"):
        calibrate([*views[:3], other], "brown4")


def test_a_board_that_is_not_flat() -> None:
    ball = board_points() + np.random.default_rng(0).normal(0, 0.05, (54, 3))
    with pytest.raises(InputError, match="expected the points of a flat board"):
        calibrate([replace(v, p_board=ball) for v in some()], "brown4")


@pytest.mark.parametrize("lens", ["brown5", "auto"])
def test_all_frontal(lens: str) -> None:
    with pytest.raises(InputError, match="tilted by 20 to 45 degrees"):
        calibrate(some(8, tilt_deg=(0.0, 0.0)), lens)


def test_all_mirrored() -> None:
    with pytest.raises(InputError, match="corners are mirrored: the board would be seen from beh"):
        calibrate([mirrored(v) for v in some()], "brown5")


def test_rows_and_columns_swapped() -> None:
    k = np.arange(54)
    points = np.stack([k % 6 - 2.5, 4 - k // 6, 0.0 * k], axis=1) * 0.025
    with pytest.raises(InputError, match=r"that can be used|no camera shows the board"):
        calibrate([replace(v, p_board=points) for v in some(8)], "brown5")


@pytest.mark.parametrize(
    ("spoil", "reason"),
    [
        (lambda v: only(v, np.arange(5)), "5 corners, at least 6"),
        (lambda v: only(v, np.arange(9)), "one line of the board"),
        (lambda v: only(v, np.array([3, 3, *range(10, 30)])), "a point is there twice"),
        (lambda v: replace(v, corners_px=v.corners_px * [1, 0] + [0, 50]), "edge on"),
        (lambda v: moved(v, 2000.0), "outside of its 1280x960"),
        (mirrored, "mirrored"),
    ],
    ids=["few", "line", "twice", "edge on", "outside", "mirrored"],
)
def test_one_bad_view_is_left_out_with_its_reason(spoil, reason: str) -> None:
    views = some(8)
    found = calibrate([spoil(views[0]), *views[1:]], "brown5")
    assert [view.source for view in found.rejected] == ["view 0"]
    assert reason in found.rejected[0].reason
    assert len(found.views) == len(found.kept) == len(found.Ts_camera_board) == 7
    assert found.camera.focal_px[0] == pytest.approx(USUAL.K[0, 0], rel=5e-3)


def test_a_repeated_view_counts_once() -> None:
    views = some(5)
    found = calibrate([*views, replace(views[2], source="again")], "brown4")
    assert [view.source for view in found.rejected] == ["again"]
    assert "shows exactly what view 2 shows" in found.rejected[0].reason


def test_partial_views_are_enough() -> None:
    rng = np.random.default_rng(3)
    parts = [only(v, np.sort(rng.choice(54, 20, replace=False))) for v in some(15)]
    found = calibrate(parts, "brown5")
    assert found.camera.focal_px[0] == pytest.approx(USUAL.K[0, 0], rel=5e-3)
    assert [e.shape for e in found.residuals_px] == [(20, 2)] * 15


def degenerate(kind: int, rng: np.random.Generator) -> list[BoardView]:
    """Return a set of views that one should not get a camera from, or only with care."""
    camera = (NARROW, USUAL, WIDE, FISHEYE)[rng.integers(4)]
    views = seen(camera, int(rng.integers(3, 8)), rng, tilt_deg=(5, 45))
    size = camera.size_px
    makers = [
        lambda: views[:1],
        lambda: seen(camera, 6, rng, tilt_deg=(0.0, float(rng.choice([0.0, 0.5, 2.0])))),
        lambda: [only(v, np.sort(rng.choice(54, 4, replace=False))) for v in views],
        lambda: [only(v, np.arange(9)) for v in views],
        lambda: [*views[:2], replace(views[2], width_px=size[0] * 2)],
        lambda: [mirrored(v) for v in views],
        lambda: [views[0]] * 6,
        lambda: [view_of(rng.uniform(0, 900, (54, 2)), size) for _ in range(6)],
        lambda: [replace(v, corners_px=np.full((54, 2), 300.0)) for v in views],
        lambda: [replace(v, corners_px=v.corners_px[rng.permutation(54)]) for v in views],
        lambda: [
            replace(views[0], corners_px=views[0].corners_px + rng.normal(0, 0.1, (54, 2)))
            for _ in range(8)
        ],
        lambda: [replace(v, p_board=v.p_board * [1, 0, 1]) for v in views],
        lambda: [only(v, np.sort(rng.choice(54, 6, replace=False))) for v in views[:3]],
    ]
    return makers[kind % len(makers)]()


def refused_or_sane(views: list[BoardView], lens: str) -> bool:
    """Say whether views are refused, or give a finite camera that is flagged or good."""
    try:
        found = calibrate(views, lens)
    except InputError as error:
        return "\n" not in str(error)
    numbers = [*found.camera.focal_px, *found.camera.center_px, *found.camera.lens.coefficients]
    assert np.isfinite(numbers).all()
    assert np.isfinite(found.camera.covariance).all()
    assert np.linalg.eigvalsh(found.camera.covariance).min() >= -1e-9
    sd = np.sqrt(np.diag(found.camera.covariance))
    good = any(
        abs(numbers[0] - truth.K[0, 0]) < 5 * sd[0] for truth in (NARROW, USUAL, WIDE, FISHEYE)
    )
    return good or bool(found.warnings)


@pytest.mark.parametrize("seed", range(13))
def test_degenerate_sets(seed: int) -> None:
    rng = np.random.default_rng(seed)
    lens = ("brown4", "brown5", "fisheye")[seed % 3]
    assert refused_or_sane(degenerate(seed, rng), lens)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(13, 213))
def test_two_hundred_degenerate_sets(seed: int) -> None:
    rng = np.random.default_rng(seed)
    lens = ("brown4", "brown8", "fisheye", "brown14", "none")[seed % 5]
    assert refused_or_sane(degenerate(seed, rng), lens)
