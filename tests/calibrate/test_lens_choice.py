"""Lenses that the views cannot tell are not chosen, however well they show them."""

from dataclasses import replace

import numpy as np
import pytest
from seen_boards import USUAL, seen

from tagmetry.calibrate import calibrate, select
from tagmetry.calibrate.fit import fit_flat
from tagmetry.calibrate.freedom import Wanted
from tagmetry.calibrate.hold_out import hold_out_px, left_out_groups
from tagmetry.calibrate.sightings import gather
from tagmetry.calibrate.view import round_covariances


def test_a_lens_whose_numbers_stay_open_gives_way_to_the_next(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    views = seen(USUAL, 10, np.random.default_rng(1))
    first = calibrate(views).choice
    real = select.covariances

    def open_for_the_first(bundle, found, freedom):
        if freedom.count == next(r for r in first.rows if r.name == first.chosen).parameters:
            raise np.linalg.LinAlgError
        return real(bundle, found, freedom)

    monkeypatch.setattr(select, "covariances", open_for_the_first)
    second = calibrate(views).choice
    assert second.chosen != first.chosen
    (row,) = [one for one in second.rows if one.name == first.chosen]
    assert row.verdict == "the views leave some of its numbers open"


@pytest.mark.parametrize(("views", "rounds", "enough", "groups"), [(12, 8, 40, 8), (200, 8, 40, 2)])
def test_no_more_views_are_left_out_than_tell(
    views: int, rounds: int, enough: int, groups: int
) -> None:
    left_out = left_out_groups(views, rounds, enough)
    assert len(left_out) == groups
    assert len(np.unique(np.concatenate(left_out))) == min(views, groups * views // rounds)


@pytest.mark.parametrize(("count", "most"), [(7, 9), (8, 18)])
def test_few_views_are_not_shown_by_many_coefficients(count: int, most: int) -> None:
    choice = calibrate(seen(USUAL, count, np.random.default_rng(2))).choice
    assert max(row.parameters for row in choice.rows) == most


def test_uncertain_corners_count_little_when_lenses_are_compared() -> None:
    rng, noisy = np.random.default_rng(3), []
    for view in seen(USUAL, 12, rng):
        sd_px = np.where(rng.random(54) < 0.5, 3.0, 0.1)
        corners_px = view.corners_px + rng.normal(0, 1, (54, 2)) * (sd_px > 1)[:, None] * 3.0
        stated = round_covariances(sd_px)
        noisy.append(replace(view, corners_px=corners_px, covariances_px2=stated))
    fit = fit_flat(gather(noisy), Wanted("brown5"), robust=False)
    expected_px = np.sqrt(2 / np.mean([view.sd_px**-2 for view in noisy]))
    assert hold_out_px(fit) == pytest.approx(expected_px, rel=0.1)
