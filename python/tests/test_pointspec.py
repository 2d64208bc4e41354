"""Answers are those of the program, whatever form patterns come in; what is refused is one exception with a sentence."""

from __future__ import annotations

import inspect
import os
import re
import signal
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pointspec

PROGRAM = os.environ.get("POINTSPEC_PROGRAM", "pointspec")
POINTS = np.random.default_rng(1).random((6, 32, 2))

# A small question for every kind of answer.
QUESTIONS: dict[str, dict[str, Any]] = {
    "power": {"sampler": ["jittered", "white"], "points": [16, 64], "realizations": 4, "max_frequency": 4},
    "angular": {"sampler": "fibonacci", "points": 32, "max_degree": 6},
    "pairs": {"sampler": "white-sphere", "points": 16, "max_degree": 6, "realizations": 3},
    "quadrature": {"sampler": "fibonacci-hemisphere", "points": 16, "brdf": "diffuse", "max_degree": 8},
    "truncation": {"brdf": "glossy:n=30", "max_degree": 6},
    "shade": {"sampler": "fibonacci-hemisphere", "points": 16, "brdf": "diffuse", "integrand": "square", "shifts": 20},
    "interpolation": {"sampler": "fibonacci", "points": 16, "integrand": "square", "smoothness": [1.1, 1.5]},
    "light": {"integrand": "cap", "max_degree": 6},
    "occlusion": {"sampler": "fibonacci", "points": 4, "image": "4x4", "reference": 4},
    "measure": {"sampler": ["jittered", "white"], "points": 16, "realizations": 3, "max_frequency": 4},
    "variance": {"sampler": "jittered", "points": [16, 64], "realizations": 9, "integrand": "disk", "rates": "auto"},
    "check": {"sampler": "jittered", "points": 16, "realizations": 30, "homogeneous": True, "max_frequency": 3},
}


@pytest.fixture(autouse=True)
def in_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("quad.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n")


def words(options: dict[str, Any]) -> list[str]:
    """The options as a command line has them."""
    line = []
    for name, value in options.items():
        several = value if isinstance(value, list) else [value]
        if several and isinstance(several[0], (int, float)) and not isinstance(several[0], bool):
            several = [",".join(map(str, several))]
        for one in several:
            line += [f"--{name.replace('_', '-')}"] + ([] if one is True else [str(one)])
    return line


def assert_same(answer: pointspec.Answer, expected: pointspec.Answer) -> None:
    assert answer.columns == expected.columns
    for name in answer.columns:
        np.testing.assert_array_equal(answer[name], expected[name])
    own = {"command", "input", "input_format", "input_columns", "points", "self_check"}
    for name, value in answer.header.items():
        if name not in own:  # what is given one by one is planned for many at once
            value, other = (re.sub(r" (at_once|group)=\d+", "", repr(one)) for one in (value, expected.header[name]))
            assert value == other, name


def test_every_kind_is_asked() -> None:
    assert sorted(QUESTIONS) == sorted(pointspec._kinds())


@pytest.mark.parametrize("kind", QUESTIONS)
def test_same_bits_as_the_program(kind: str) -> None:
    options = dict(QUESTIONS[kind])
    if kind == "occlusion":
        options["mesh"] = "quad.obj"
    subprocess.run([PROGRAM, kind, *words(options), "-o", "own.npz", "--quiet"], check=True, capture_output=True)
    assert_same(getattr(pointspec, kind)(**options), pointspec.load("own.npz"))


def test_forms_of_patterns() -> None:
    expected = pointspec.power(POINTS, max_frequency=4)
    np.save("points.npy", POINTS)
    layouts = np.asfortranarray(POINTS), POINTS.astype(">f8"), np.repeat(POINTS, 2, axis=0)[::2]
    frozen = POINTS.copy()
    frozen.flags.writeable = False
    forms: list[Any] = [*layouts, frozen, list(POINTS), (set for set in POINTS), POINTS.tolist(), Path("points.npy"), ["points.npy"]]
    for form in forms:
        assert_same(pointspec.power(form, max_frequency=4), expected)
    single = POINTS.astype(np.float32)
    assert_same(pointspec.power(single, max_frequency=4), pointspec.power(single.astype(np.float64), max_frequency=4))


def test_a_sampler_is_asked_for_realizations() -> None:
    asked = []

    def sampler(n: int, seed: int, realization: int) -> np.ndarray:
        asked.append((n, seed, realization))
        return np.random.default_rng((seed, realization)).random((n, 2))

    answer = pointspec.power(sampler, points=32, seed=7, realizations=5, max_frequency=4)
    sets = np.array([sampler(32, 7, r) for r in range(5)])
    assert_same(answer, pointspec.power(sets, max_frequency=4))
    assert set(asked) == {(32, 7, r) for r in range(5)}


def test_curves_beside_samplers_and_rates() -> None:
    own = {"mine": {n: np.random.default_rng(n).random((8, n, 2)) for n in (16, 64)}}
    answer = pointspec.variance(own, sampler="jittered", points=[16, 64], realizations=8, integrand="disk", rates="auto")
    assert answer.sampler.tolist() == ["jittered", "jittered", "mine", "mine"]
    assert [text.split(",")[0] for text in answer.header["rates"]] == ["jittered", "mine"]

    def sampler(n: int, seed: int, realization: int) -> np.ndarray:
        return np.random.default_rng((n, seed, realization)).random((n, 2))

    made = pointspec.variance({"mine": sampler}, points=[16, 64], realizations=8, integrand="disk", rates="auto")
    assert made.points.tolist() == [16, 64] and len(made.header["rates"]) > 0


def test_weights() -> None:
    weights = np.random.default_rng(2).random(POINTS.shape[:2])
    expected = pointspec.power(list(POINTS), weights=list(weights), max_frequency=4)
    assert_same(pointspec.power(POINTS, weights=weights, max_frequency=4), expected)
    same = pointspec.power(POINTS, weights=weights[0], max_frequency=4)
    assert_same(same, pointspec.power(POINTS, weights=np.tile(weights[0], (6, 1)), max_frequency=4))
    assert same["weight_sum"] == pytest.approx(weights[0].sum())


def test_calls_after_another_have_its_plan_and_no_more() -> None:
    other = np.random.default_rng(5).random(POINTS.shape)
    weights = np.random.default_rng(2).random(POINTS.shape[:2])
    expected = [pointspec.power([*one], max_frequency=4) for one in (POINTS, other)]
    for _ in range(2):
        for points, answer in zip((POINTS, other), expected):
            assert_same(pointspec.power(points, max_frequency=4), answer)
        weighted = pointspec.power(POINTS, max_frequency=4, weights=weights)
        assert_same(weighted, pointspec.power([*POINTS], max_frequency=4, weights=[*weights]))
        with pytest.raises(pointspec.InputError):
            pointspec.power(POINTS + 1, max_frequency=4)
        assert len(pointspec.power(POINTS, max_frequency=3)) == 3
        assert pointspec.plan("power", POINTS, max_frequency=4).columns[0] == "engine"


def test_weights_of_functions_and_generators() -> None:
    weights = np.random.default_rng(2).random(POINTS.shape[:2])
    expected = pointspec.power(POINTS, weights=weights, max_frequency=4)
    assert_same(pointspec.power(zip(POINTS, weights), max_frequency=4), expected)
    made = pointspec.power(lambda n, seed, r: (POINTS[r], weights[r]), realizations=6, max_frequency=4)
    assert_same(made, expected)
    for patterns in ({"mine": POINTS}, iter(POINTS), lambda n, seed, r: POINTS[r]):
        with pytest.raises(ValueError, match="weights: functions and generators give tuples"):
            pointspec.power(patterns, weights=weights, max_frequency=4)


def test_generators_are_not_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    def cluster() -> Any:
        """Powers near N, which need a second plan."""
        for r in range(4):
            yield np.full((300, 2), 0.5) + 1e-5 * np.random.default_rng(r).random((300, 2))

    expected = pointspec.power([*cluster()], max_frequency=8)
    assert "planned_twice" in expected
    assert_same(pointspec.power(cluster(), max_frequency=8), expected)
    monkeypatch.setattr("pointspec._question._MOST_KEPT", 5000)
    with pytest.raises(ValueError, match="a generator comes once"):
        pointspec.power(cluster(), max_frequency=8)
    assert_same(pointspec.power(iter(POINTS), max_frequency=4), pointspec.power(POINTS, max_frequency=4))


def test_files_are_read_again() -> None:
    Path("list.txt").write_text("1 0\n")
    assert len(pointspec.power(POINTS, frequencies="list.txt")) == 1
    Path("list.txt").write_text("1 0\n2 0\n")
    assert len(pointspec.power(POINTS, frequencies="list.txt")) == 2


def test_arrays_are_options() -> None:
    frequencies = np.array([[1, 0], [2, -3]])
    answer = pointspec.power(POINTS, frequencies=frequencies)
    assert answer.k1.tolist() == [1, 2] and answer.k2.tolist() == [0, -3]
    full = pointspec.power(POINTS, max_frequency=3, full=True)
    assert full.full.shape == (7, 7)
    coefficients = pointspec.angular(sampler="fibonacci", points=16, max_degree=4, coefficients=True)
    assert coefficients.coefficients.dtype == np.complex128


def test_integrands() -> None:
    square = pointspec.Integrand(lambda x: x[:, 0] ** 2, 1 / 3, "square")
    answer = pointspec.variance(POINTS, integrand=[square, "disk"], max_frequency=4)
    assert answer.integrand.tolist() == ["square", "disk"]
    assert np.isnan(answer.predicted[0]) and answer.measured[0] > 0


def test_memory_is_shared_and_outlives_the_answer() -> None:
    answer = pointspec.power(POINTS, max_frequency=4)
    power, copy = answer.power, answer.power.copy()
    assert not power.flags.writeable and not power.flags.owndata
    del answer
    np.testing.assert_array_equal(power, copy)


def test_nothing_is_left_behind() -> None:
    def ask() -> None:
        answer = pointspec.power(POINTS, max_frequency=4, full=True)
        assert answer.full.shape == (9, 9) and answer.header and repr(answer)

    pages = []
    for _ in range(6):
        for _ in range(100):
            ask()
        pages.append(int(Path("/proc/self/statm").read_text().split()[1]))
    assert min(after - before for before, after in zip(pages, pages[1:])) < 100  # an answer that stays has five


def test_save_load_merge_check() -> None:
    first, second = (pointspec.power(POINTS[i::2], max_frequency=4, state=True) for i in (0, 1))
    both = pointspec.merge(first, second)
    assert both["realizations"] == 6
    both.save("both.npz")
    assert_same(pointspec.load("both.npz"), both)
    both.save("both.csv")
    assert Path("both.csv").read_text().count("\n") > 4
    same = pointspec.check(np.random.default_rng(3).random((40, 32, 2)), against=both)
    assert same.verdict == ""
    other = pointspec.check(sampler="jittered", points=32, realizations=40, against=both)
    assert "differ" in other.verdict


def test_signatures_are_those_of_the_tables() -> None:
    for kind in [*pointspec._kinds(), *pointspec._COMMANDS]:
        function = getattr(pointspec, kind)
        names = set(inspect.signature(function).parameters)
        for row in pointspec._answer.rows(kind, "options"):
            name = row["option"].replace("-", "_")
            assert name == "files" or name in names
            assert name in ("files", "weights") or row["help"] in function.__doc__


def test_scenes_are_dicts() -> None:
    np.save("points.npy", POINTS)
    scene = {"scene": 1, "results": [{"result": "power", "sets": {"mine": "points.npy"}, "max-frequency": 4}]}
    answer = pointspec.run(scene, output="folder")
    assert len(answer) == 1 and [path.name for path in Path().glob("pointspec-*")] == []
    table = next(Path("folder").glob("power*.csv")).read_text().splitlines()
    assert table[-1].endswith(str(pointspec.power(POINTS, max_frequency=4).anisotropy_db[-1]))


def test_plan_and_commands() -> None:
    plan = pointspec.plan("power", POINTS, max_frequency=4)
    assert "chosen" in plan.verdict_.tolist() if "verdict_" in plan else "chosen" in plan["verdict"].tolist()
    points = pointspec.sample(sampler="jittered", points=16, realizations=3)
    assert points.coordinates.shape == (3, 16, 2)
    pointspec.convert(POINTS, output="out.npy")
    np.testing.assert_array_equal(np.load("out.npy"), POINTS)
    assert len(pointspec.devices()) >= 0


@pytest.mark.parametrize(
    ("patterns", "error", "sentence"),
    [
        (np.array([["a"]]), TypeError, "points: an array of <U1 is none of real numbers"),
        (np.array([[None, 1]]), TypeError, "points: an array of object"),
        (np.zeros(5), ValueError, r"points: an array of shape \(5,\) has no points"),
        (np.zeros((0, 2)), ValueError, r"points: an array of shape \(0, 2\)"),
        ([], ValueError, "points: an empty list"),
        ([np.zeros((3, 2)), np.zeros(2)], ValueError, r"points\[1\]: an array of shape"),
        (np.full((4, 2), np.nan), pointspec.InputError, "memory"),
        (np.full((4, 2), 1.5), pointspec.InputError, "1.5"),
        (3, TypeError, "points: int is no array"),
        ("nothing.dat", pointspec.PointspecError, "nothing.dat"),
    ],
)
def test_bad_patterns(patterns: Any, error: type[Exception], sentence: str) -> None:
    with pytest.raises(error, match=sentence):
        pointspec.power(patterns, max_frequency=2)


def test_bad_options() -> None:
    with pytest.raises(pointspec.InvalidArgumentError, match="max-freq"):
        pointspec.power(POINTS, max_freq=3)
    with pytest.raises(TypeError, match="max_frequency: complex"):
        pointspec.power(POINTS, max_frequency=3j)
    with pytest.raises(pointspec.InvalidArgumentError):
        pointspec.power(POINTS, max_frequency=-1)
    with pytest.raises(ValueError, match="weights"):
        pointspec.power(POINTS, weights=np.ones(5), max_frequency=2)
    with pytest.raises(pointspec.ToleranceError):
        pointspec.power(POINTS, max_frequency=2, tol=1e-300)


def test_exceptions_pass_through() -> None:
    def generator() -> Any:
        yield POINTS[0]
        raise KeyError("mine")

    def sampler(n: int, seed: int, realization: int) -> Any:
        raise ZeroDivisionError("mine")

    def values(points: np.ndarray) -> Any:
        raise LookupError("mine")

    with pytest.raises(KeyError, match="mine"):
        pointspec.power(generator(), max_frequency=2)
    with pytest.raises(ZeroDivisionError, match="mine"):
        pointspec.power(sampler, points=8, realizations=2, max_frequency=2)
    with pytest.raises(LookupError, match="mine"):
        pointspec.variance(POINTS, integrand=pointspec.Integrand(values, 1), max_frequency=2)
    with pytest.raises(ValueError, match=r"integrand f: \d+ points have values of shape \(1,\)"):
        pointspec.variance(POINTS, integrand=pointspec.Integrand(lambda x: np.ones(1), 1), max_frequency=2)
    pointspec.power(POINTS, max_frequency=2)  # nothing is left of it


def test_progress_and_cancelling() -> None:
    heard = []
    pointspec.power(
        sampler="white", points=64, realizations=3000, max_frequency=4, progress=lambda *said: heard.append(said)
    )
    assert heard and all(isinstance(phase, str) and done <= total for phase, done, total, _ in heard)

    def stop(*said: Any) -> None:
        raise StopIteration("enough")

    with pytest.raises(StopIteration, match="enough"):
        pointspec.power(sampler="white", points=64, realizations=3000, max_frequency=4, progress=stop)


def test_arrays_go_on_from_a_checkpoint() -> None:
    points = np.random.default_rng(2).random((200, 8, 2))
    asked: dict[str, Any] = {"max_frequency": 3, "engine": "host_direct"}
    left = 2

    def stop(*said: Any) -> None:
        nonlocal left
        left -= 1
        if left == 0:
            raise StopIteration("enough")

    with pytest.raises(StopIteration):
        pointspec.power(points, **asked, checkpoint="job.npz", progress=stop)
    with pytest.raises(pointspec.InputError, match="checkpoint of another job"):
        pointspec.power(points / 2, **asked, checkpoint="job.npz")
    pieces = pointspec.power(points, **asked, checkpoint="job.npz")
    assert np.array_equal(pieces["power"], pointspec.power(points, **asked)["power"])
    assert not Path("job.npz").exists()


def test_bars() -> None:
    pytest.importorskip("tqdm")
    pointspec.power(sampler="white", points=64, realizations=3000, max_frequency=4, progress=True)


def test_interrupts_end_the_call() -> None:
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        pointspec.power(sampler="white", points=4096, realizations=1000000, max_frequency=64)
    timer.join()
    pointspec.power(POINTS, max_frequency=2)


def test_warnings_are_pythons() -> None:
    with pytest.warns(pointspec.PointspecWarning, match="standard error"):
        pointspec.power(sampler="white", points=16, realizations=16, max_frequency=2, standard_error=0.001)


def test_threads() -> None:
    expected = pointspec.power(POINTS, max_frequency=4)
    found: list[pointspec.Answer] = []
    threads = [threading.Thread(target=lambda: found.append(pointspec.power(POINTS, max_frequency=4))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 4
    for answer in found:
        assert_same(answer, expected)


def run(program: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)


def test_forks_are_named() -> None:
    done = run(
        "import os, pointspec\n"
        "pointspec.power(sampler='white', points=8, max_frequency=2)\n"
        "if os.fork() == 0:\n"
        "    try: pointspec.power(sampler='white', points=8, max_frequency=2)\n"
        "    except RuntimeError as error: print(error); os._exit(0)\n"
        "    os._exit(1)\n"
        "print(os.wait()[1])\n"
    )
    assert "before this process was forked" in done.stdout and done.stdout.endswith("0\n"), done


def test_arrays_are_not_copied() -> None:
    done = run(
        "import numpy, pointspec, resource\n"
        "points = numpy.random.default_rng(1).random((200, 40000, 2))\n"  # 128 MB
        "pointspec.power(points[:8], max_frequency=4)\n"
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "pointspec.power(points, max_frequency=4)\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)\n"
    )
    assert int(done.stdout) < 40000, done  # kilobytes; engines have buffers


def test_shown() -> None:
    answer = pointspec.power(POINTS, max_frequency=12)
    assert repr(answer).splitlines()[0].split() == answer.columns and "..." in repr(answer)
    assert answer._repr_html_().startswith("<table><tr><th>bin</th>")
    assert answer.units.get("anisotropy_db") == "dB"
    assert "power" in dir(answer) and "power" in answer and "nothing" not in answer
    with pytest.raises(AttributeError, match="no field 'nothing'"):
        answer.nothing
    with pytest.raises(KeyError):
        answer["nothing"]


def test_pandas() -> None:
    pandas = pytest.importorskip("pandas")
    answer = pointspec.power(POINTS, max_frequency=4)
    frame = answer.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and frame.attrs["realizations"] == 6
    np.testing.assert_array_equal(frame["power"], answer.power)


def test_pictures() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    one = pointspec.power(POINTS, max_frequency=4)
    two = pointspec.power(sampler="jittered", points=36, realizations=4, max_frequency=4)
    axes = pointspec.plot(one, two, labels=["mine", "theirs"])
    lines = {line.get_label(): line for line in axes.get_lines() if not line.get_label().startswith("_")}
    assert list(lines) == ["mine", "theirs"] and len(axes.containers) == 2
    np.testing.assert_array_equal(lines["mine"].get_xdata(), one.normalized_frequency)
    np.testing.assert_array_equal(lines["theirs"].get_ydata(), two.power)
    assert axes.get_xlabel() == "normalized frequency" and axes.get_yscale() == "linear"

    options = dict(QUESTIONS["variance"], sampler=["jittered", "white"], integrand=["disk", "gaussian"])
    answer = pointspec.variance(**options)
    left, right = answer.plot()
    assert [text.get_text() for text in left.get_legend().get_texts()] == ["jittered", "white noise", "white"]
    assert left.get_yscale() == right.get_yscale() == "log" and "gaussian" in right.get_ylabel()
    drawn = next(line for line in right.get_lines() if line.get_label() == "white")
    own = (answer.integrand == "gaussian") & (answer.sampler == "white")
    np.testing.assert_array_equal(drawn.get_ydata(), answer.predicted[own])

    errors = pointspec.shade(**dict(QUESTIONS["shade"], points=[16, 32]))
    assert [line.get_label() for line in errors.plot().get_lines()][0] == "fibonacci-hemisphere"
    with pytest.raises(ValueError, match="no picture"):
        pointspec.occlusion(mesh="quad.obj", **QUESTIONS["occlusion"]).plot()
    with pytest.raises(ValueError, match="there is no answer"):
        pointspec.plot()


def test_images() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    answer = pointspec.power(POINTS, max_frequency=4, full=True)
    points, image, curve = answer.plot()
    np.testing.assert_array_equal(points.collections[0].get_offsets(), POINTS[0])
    drawn = np.ma.filled(image.images[0].get_array(), np.nan)
    assert np.isnan(drawn[4, 4]) and tuple(image.images[0].get_extent()) == (-4.5, 4.5, -4.5, 4.5)
    shown = np.arange(81).reshape(9, 9) != 40
    np.testing.assert_array_equal(drawn[shown], answer.full.T[shown])
    np.testing.assert_array_equal(curve.get_lines()[0].get_ydata(), answer.power)
    assert answer.plot(ax=curve) is curve

    options = dict(QUESTIONS["occlusion"], sampler=["fibonacci", "white-sphere"], state=True)
    answer = pointspec.occlusion(mesh="quad.obj", **options)
    axes = answer.plot()
    assert [one.get_title() for one in axes[::2]] == ["image, sampler fibonacci", "error, sampler fibonacci"]
    np.testing.assert_array_equal(axes[3].images[0].get_array(), answer.error[1])
    with pytest.raises(ValueError, match="one panel does not hold 4 images"):
        answer.plot(ax=axes[0])

    cap, square, powers = pointspec.light(integrand=["cap:angle=0.5", "square"], max_degree=4, state=True).plot()
    assert cap.get_title().startswith("cap") and square.get_title() == "square" and powers.get_yscale() == "log"


def test_plan_beside() -> None:
    # at 1e-6 powers may need a second plan
    answer = pointspec.power(POINTS, max_frequency=4, tol=1e-5, plan=True)
    assert answer.plan is not None and answer.header["engine"].startswith("(" + answer.plan.engine[0].split(":")[0])
    assert pointspec.power(POINTS, max_frequency=4).plan is None
