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
        cli("convert", f"demo:objects?size=64&grid={9 if name == 'scene' else 3}", name + "/lf.h5", "--quiet")
    lf = episcope.open("scene")
    numpy.save("network.npy", lf.truth[4, 4])
    episcope.estimate(lf, "epi_l").save("result.h5")
    return tmp_path


@pytest.mark.parametrize("number", range(len(examples("python"))))
def test_python(number, folder):
    code = examples("python")[number]
    for module in re.findall(r"\b(pandas|matplotlib|h5py)\b", code):
        pytest.importorskip(module)
    exec(compile(code, f"example {number}", "exec"), {})
    if "strokes.h5" in code:
        assert pathlib.Path("strokes.h5").stat().st_size > 0


def test_every_kind_of_example_is_found():
    assert len(examples("python")) >= 6
    assert len(examples("matlab")) >= 1


@pytest.mark.parametrize("number", range(len(examples("matlab"))))
def test_octave(number, folder):
    if not shutil.which("octave-cli"):
        pytest.skip("there is no Octave")
    setup = "pkg load hdf5oct; set(0, 'defaultfigurevisible', 'off');\n"
    if subprocess.run(["octave-cli", "--eval", "pkg load hdf5oct"], capture_output=True).returncode != 0:
        pytest.skip("Octave has no h5read")
    check = "\nassert(size(center), [64 64]); assert(size(views), [9 9 64 64 3]);"
    subprocess.run(["octave-cli", "--eval", setup + examples("matlab")[number] + check], check=True)
