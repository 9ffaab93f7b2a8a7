# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the package share."""
import json
import os
import subprocess

import pytest

import episcope

# Large enough for the border of 15 px that the benchmark of 2016 leaves out.
SCENE = "objects?size=64&grid=5"


@pytest.fixture(scope="session")
def scene():
    """A small scene with truth and labels."""
    return episcope.demo(SCENE)


@pytest.fixture
def cli(tmp_path):
    """Runs the command line in the folder of the test; the answer is what it prints, as JSON if it is."""

    def run(*arguments):
        done = subprocess.run(
            [os.environ["EPISCOPE_CLI"], *arguments], cwd=tmp_path, check=True, capture_output=True, text=True
        )
        return json.loads(done.stdout) if "--json" in arguments else done.stdout

    return run
