# %% [markdown]
# A machine in five lines: the example wheel loader, from its CAD model and its specification sheet.
# Run it from the repository's root, or cell by cell in a notebook: `python docs/scripts/five_lines.py [OUT]`.

# %%
import sys

import yellowiron as yi

out = sys.argv[1] if len(sys.argv) > 1 else "out/five_lines"
example = "examples/wheel_loader"
machine = yi.build("wheel_loader", f"{example}/wheel_loader.step", out, sheets=[f"{example}/specifications.pdf"])

# %% What fell short, and what to open: the scene in any USD viewer, the report in a browser.
print(machine.fell_short or "Ready.", machine.scene, machine.report, sep="\n")

# %% Every published value beside the model's.
for measurement in machine.measurements:
    print(f"{measurement.name:35}{measurement.spec or 0.0:10.4f}{measurement.model:10.4f} {measurement.unit}")
