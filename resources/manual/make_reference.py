#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""make_reference.py CLI PAGE: writes PAGE, the parameters of every method and the options of every verb, as CLI tells them."""
import json
import re
import subprocess
import sys
from pathlib import Path


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


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


def methods(cli):
    text = ["## Methods\n"]
    for method in json.loads(run(cli, "methods", "--json"))["methods"]:
        views = "all views" if method["all_views"] else "one view"
        text += [
            f"### {method['name']}\n",
            f"`{method['id']}` · {views} · {method['reference']}\n",
            f"{method['summary']}.\n",
            parameter_table(method["parameters"]) + "\n",
        ]
    return text


def verbs(cli):
    overview = run(cli, "--help")
    names = re.findall(r"^  ([a-z][a-z-]+)  ", overview, re.MULTILINE)
    if not names:
        sys.exit("make_reference.py: the command line lists no verbs")
    text = ["## Command line\n", "```", overview.strip(), "```\n"]
    for verb in names:
        text += [f"### {verb}\n", "```", run(cli, verb, "--help").strip(), "```\n"]
    return text


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    cli = str(Path(sys.argv[1]).resolve())
    Path(sys.argv[2]).write_text("\n".join(["# Parameters and options\n"] + methods(cli) + verbs(cli)))


if __name__ == "__main__":
    main()
