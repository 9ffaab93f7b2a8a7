# SPDX-License-Identifier: BSD-3-Clause
"""The examples of the page "Python and MATLAB" run as they stand there."""
import os
import pathlib
import re
import shutil
import subprocess

import numpy
import pytest

import episcope


def examples(language):
    text = pathlib.Path(os.environ["EPISCOPE_PAGE"]).read_text()
    return re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)


@pytest.fixture
def folder(tmp_path, monkeypatch, cli):
    """A folder with what the examples name."""
    monkeypatch.chdir(tmp_path)
    for name in ["scene", "scenes/one", "scenes/two"]:
        os.makedirs(name)
        options = "size=64" if name == "scene" else "size=40&grid=3"
        cli("convert", "demo:objects?" + options, name + "/lf.h5", "--quiet")
    lf = episcope.open("scene")
    numpy.save("network.npy", lf.truth[4, 4])
    episcope.estimate(lf, "epi_l").save("result.h5")
    return tmp_path


@pytest.mark.parametrize("number", range(len(examples("python"))))
def test_python(number, folder):
    code = examples("python")[number]
    for module in re.findall(r"\b(pandas|matplotlib|h5py|xarray|h5netcdf)\b", code):
        pytest.importorskip(module)
    if 'save("result.h5")' in code:
        pathlib.Path("result.h5").unlink()
    exec(compile(code, f"example {number}", "exec"), {})
    if "strokes.h5" in code:
        assert pathlib.Path("strokes.h5").stat().st_size > 0


def test_every_kind_of_example_is_found():
    assert len(examples("python")) >= 7
    assert len(examples("matlab")) == 2
    assert len(examples("octave")) == 1


# What MATLAB has and Octave lacks: it gives arrays in the same order.
H5READ = """1;
function array = h5read(name, path)
  array = load('-hdf5', name);
  for part = strsplit(path(2:end), '/')
    array = array.(part{1});
  end
end
"""


def h5readatt():
    """What MATLAB reads attributes with; Octave reads none."""
    h5py = pytest.importorskip("h5py")
    with h5py.File("result.h5") as file:
        cases = [
            f"case '{name}'; value = " + (f"'{value}'" if isinstance(value, str) else repr(float(value))) + ";"
            for name, value in file["estimate"].attrs.items()
            if name in ("dH", "focalLength", "shift", "method")
        ]
    return "function value = h5readatt(name, path, key)\n switch key\n" + "\n".join(cases) + "\n end\nend\n"


@pytest.mark.parametrize("language", ["matlab", "octave"])
def test_octave(language, folder):
    if not shutil.which("octave-cli"):
        pytest.skip("there is no Octave")
    pathlib.Path("example.m").write_text(
        (H5READ + h5readatt() if language == "matlab" else "")
        + "".join(examples(language))
        + "printf('%.9g ', disparity(2, 3, 10, 20), center(7, 8));\n"
        + "printf('%d ', views(2, 3, 10, 20, 3), size(views));\n"
    )
    printed = subprocess.run(["octave-cli", "--norc", "example.m"], check=True, capture_output=True, text=True).stdout
    lf = episcope.open("scene")
    expected = episcope.estimate(lf, "epi_l").disparity
    *disparities, sample, v, u, y, x, c = map(float, printed.split())
    assert disparities == pytest.approx([expected[1, 2, 9, 19], expected[4, 4, 6, 7]], rel=1e-7)
    assert sample == lf.views[1, 2, 9, 19, 2]
    assert (v, u, y, x, c) == lf.views.shape


def test_matlab_finds_depth(folder):
    if not shutil.which("octave-cli"):
        pytest.skip("there is no Octave")
    pathlib.Path("example.m").write_text(
        H5READ + h5readatt() + "".join(examples("matlab")) + "printf('%.9g %s', depth(2, 3, 10, 20), method);\n"
    )
    printed = subprocess.run(["octave-cli", "--norc", "example.m"], check=True, capture_output=True, text=True).stdout
    depth, method = printed.split()
    lf = episcope.open("scene")
    expected = lf.camera.depth(episcope.estimate(lf, "epi_l").disparity[1, 2, 9, 19])
    assert float(depth) == pytest.approx(float(expected), rel=1e-6)
    assert method == "epi_l"
