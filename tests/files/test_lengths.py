import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.files.lengths import parse_length_m, parse_sizes_m


@given(st.floats(1e-6, 1e6))
def test_reads_metres_as_they_were_written(length_m: float) -> None:
    assert parse_length_m(repr(length_m)) == length_m


@given(
    st.floats(1e-3, 1e3), st.sampled_from([("mm", 1e-3), ("cm", 1e-2), ("m", 1), ("in", 0.0254)])
)
def test_a_unit_scales_the_number(number: float, unit: tuple[str, float]) -> None:
    assert parse_length_m(f" {number!r} {unit[0].upper()} ") == pytest.approx(number * unit[1])


@pytest.mark.parametrize(
    ("text", "length_m"),
    [
        ("0.12", 0.12),
        ("120mm", 0.12),
        ("12cm", 0.12),
        (".12m", 0.12),
        ("4in", 0.1016),
        ("1e-1", 0.1),
    ],
)
def test_the_spellings_that_are_promised(text: str, length_m: float) -> None:
    assert parse_length_m(text) == pytest.approx(length_m, abs=1e-15)


@pytest.mark.parametrize(
    "text",
    ["", " ", "0", "0mm", "-1", "-5cm", "nan", "inf", "-inf", "1e999", "1e-999mm", "mm",
     "1e300", "1e-300",
     "12 furlongs", "1_000", "0x10", "1,5", "12mm mm", "١٢", "1 2", "--1", "infinity",
     "9" * 5000],
)  # fmt: skip
def test_refuses_what_is_no_length(text: str) -> None:
    with pytest.raises(InputError, match="expected a length above 0 like") as refusal:
        parse_length_m(text)
    assert repr(text[:10])[1:-1] in str(refusal.value)
    assert len(str(refusal.value)) < 200


def test_one_size_or_sizes_by_id() -> None:
    assert parse_sizes_m("12cm") == pytest.approx(0.12)
    assert parse_sizes_m("7=0.05, 8=12cm") == {7: 0.05, 8: pytest.approx(0.12)}


@pytest.mark.parametrize("text", ["x=1", "7=0.05,", "-1=0.1", "7=1,0.2", "=", "1.5=2", "²=1"])
def test_refuses_what_is_no_size_by_id(text: str) -> None:
    with pytest.raises(InputError, match=r"expected sizes by id like 7=0\.05,8=12cm, found"):
        parse_sizes_m(text)


@pytest.mark.parametrize("text", ["7=", "7=0", "7=nan", "7=0.1,8=-2", "7=8=9"])
def test_refuses_a_bad_length_by_id(text: str) -> None:
    with pytest.raises(InputError, match="expected a length above 0"):
        parse_sizes_m(text)


def test_refuses_an_id_given_twice() -> None:
    with pytest.raises(InputError, match=r"id 7 has two sizes in '7=1,7=2'; give one"):
        parse_sizes_m("7=1,7=2")
