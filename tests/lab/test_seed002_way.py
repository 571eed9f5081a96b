"""Ways of a camera: what is measured on them, and what is said of the filter."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from tagmetry.lab.beside.sample import sample
from tagmetry.lab.beside.seed002_way import conclude
from tagmetry.lab.experiments import seed002_way
from tagmetry.lab.rigs.marker_floor import Stand, camera_place
from tagmetry.lab.rigs.wandering import LOSS_S, MOTION, STEP_S, _way, followed, followed_methods
from tagmetry.lab.rows import Followed


def test_a_camera_wanders_as_the_filter_s_model_has_it():
    rng = np.random.default_rng(0)
    start = camera_place(Stand("one", 3.0), rng)
    ends = []
    for _ in range(300):
        moments = list(_way(start, 11, rng))
        ends.append(moments[-2].T_world_camera.translation - start.translation)
    assert [one.gap_s for one in moments] == [0.0] + [STEP_S] * 10 + [LOSS_S]
    assert moments[-1].time_s == pytest.approx(1.0 + LOSS_S)
    expected_m = MOTION.acceleration_m_s2 * np.sqrt(1.0 / 3)  # of one second from rest
    np.testing.assert_allclose(np.std(ends, axis=0), expected_m, rtol=0.15)


def test_every_method_is_measured_in_every_image_and_again_after_the_loss():
    rows = list(followed(Stand("four inclined", 2.5), 4, 0, 3))
    assert [row.method for row in rows] == 5 * list(followed_methods())
    last = [row for row in rows if row.image == 4]
    assert {row.gap_s for row in last} == {LOSS_S}
    assert all(row.radial_m < 0.02 for row in rows if row.method in ("joint", "filter"))
    assert all(np.isnan(row.surprise2) for row in rows if row.method != "filter")
    assert np.isfinite([row.surprise2 for row in rows if row.method == "filter"][1:]).all()


def rows_of(scale):
    """Innovations as twenty equally likely ones are, some times larger."""
    surprises2 = [*(scale * chi2.ppf((np.arange(20) + 0.5) / 20, 6)), np.nan]
    return [
        Followed(
            method, layout, 3.0, repeat, image, 2.0 if image == 10 else 0.1 * (image > 0),
            0.01, 0.01, 6.0, surprises2[repeat if method == "filter" else -1],
        )
        for method in ("joint", "filter")
        for layout in ("one", "two")
        for repeat in range(20)
        for image in range(11)
    ]  # fmt: skip


def test_right_innovations_hold_and_others_do_not():
    assert [one.holds for one in conclude(rows_of(1.0)).checks] == [True, True, True]
    assert [one.holds for one in conclude(rows_of(1.5)).checks] == [False, False, True]
    assert [one.holds for one in conclude(rows_of(0.6)).checks] == [False, False, True]


def test_an_image_after_the_loss_that_is_not_heeded_is_told_one_without_markers_is_not():
    rows = rows_of(1.0)
    n = next(n for n, r in enumerate(rows) if r.method == "filter" and r.image == 10)
    rows[n] = replace(rows[n], surprise2=np.nan)
    assert conclude(rows).checks[2].holds is False
    rows[n] = replace(rows[n], radial_m=np.nan)
    assert conclude(rows).checks[2].holds is True
    assert conclude(rows).checks[2].required == "all 39"


def test_cases_and_tables():
    assert len(seed002_way.cases(quick=True)) == 10
    conclusions = conclude(rows_of(1.0))
    assert [one.name for one in conclusions.tables] == ["seed002_way", "seed002_surprise"]
    assert conclusions.tables[0].rows[1] == ("filter", 10.0, 10.0)
    assert len(sample(rows_of(1.0)).without(layout="one").rows) == 440
