#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""make_pages.py CLI MANUAL PAGES: writes the pages that the programs tell themselves into PAGES.

methods.md (with a picture of each method's result), commands.md, forms.md (from the README).
"""
import json
import re
import subprocess
import sys
from pathlib import Path

SCENE = "demo:demo?size=256"
SLOW = {"kz02", "plane_pm"}  # their pictures are made of a smaller scene
SMALL_SCENE = "demo:demo?size=128"
FORMS_HEADING = "## What it opens and writes"


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def formula(folder, method):
    """A method's own text, or that of its costs and of what is made of them."""
    own = folder / f"{method}.md"
    if own.exists():
        return own.read_text()
    costs, _, rest = method.rpartition("_")
    return (folder / f"{costs}.md").read_text() + "\n" + (folder / f"st_{rest}.md").read_text()


def cell(text):
    return str(text).replace("|", "\\|").replace("<", "&lt;").replace("\n", " ")


def allowed(parameter):
    if "choices" in parameter:
        return ", ".join(f"`{choice}`" for choice in parameter["choices"])
    if "min" in parameter and "max" in parameter:
        return f"{parameter['min']:g} … {parameter['max']:g}"
    return ""


def parameter_table(parameters):
    rows = ["| parameter | default | values | what it is |", "|---|---|---|---|"]
    for p in parameters:
        default = p["default"]
        default = f"{default:g}" if isinstance(default, float) else str(default)
        unit = f" {p['unit']}" if p["unit"] else ""
        rows.append(f"| `{p['key']}` | {cell(default)}{cell(unit)} | {cell(allowed(p))} | {cell(p['help'])} |")
    return "\n".join(rows)


def take_map(cli, method, pages):
    result = pages / "pictures" / f"{method}.h5"
    picture = pages / "pictures" / f"{method}.png"
    scene = SMALL_SCENE if method in SLOW else SCENE
    run(cli, "estimate", method, scene, "-o", str(result))
    run(cli, "show", str(result), "--what", "disparity", "-o", str(picture))
    result.unlink()


def methods_page(cli, manual, pages):
    methods = json.loads(run(cli, "methods", "--json"))["methods"]
    text = ["# Methods\n", "Pictures show the disparity of the centre view of the built-in scene, by the defaults.\n"]
    for method in methods:
        take_map(cli, method["id"], pages)
        views = "all views" if method["all_views"] else "one view"
        text += [
            f"## {method['name']}\n",
            f"`{method['id']}` · {views} · {method['reference']}\n",
            f"{method['summary']}.\n",
            formula(manual / "formulas", method["id"]),
            f"![Disparity by {method['name']}](pictures/{method['id']}.png)\n",
            parameter_table(method["parameters"]) + "\n",
        ]
    (pages / "methods.md").write_text("\n".join(text))


def commands_page(cli, pages):
    overview = run(cli, "--help")
    verbs = re.findall(r"^  ([a-z][a-z-]+)  ", overview, re.MULTILINE)
    if not verbs:
        sys.exit("make_pages.py: the command line lists no verbs")
    text = ["# Command line\n", "```", overview.strip(), "```\n"]
    for verb in verbs:
        text += [f"## {verb}\n", "```", run(cli, verb, "--help").strip(), "```\n"]
    (pages / "commands.md").write_text("\n".join(text))


def forms_page(manual, pages):
    readme = (manual.parent.parent / "README.md").read_text()
    section = re.search(rf"^{re.escape(FORMS_HEADING)}\n(.*?)(?=^## )", readme, re.MULTILINE | re.DOTALL)
    if not section:
        sys.exit(f"make_pages.py: README.md has no section '{FORMS_HEADING}'")
    without_pictures = re.sub(r"!\[[^\]]*\]\([^)]*\)\n*", "", section[1])
    (pages / "forms.md").write_text("# Forms of light fields\n" + without_pictures)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    cli = str(Path(sys.argv[1]).resolve())
    manual, pages = Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()
    methods_page(cli, manual, pages)
    commands_page(cli, pages)
    forms_page(manual, pages)


if __name__ == "__main__":
    main()
