# %% [markdown]
# A loop over strokes: how high the bucket's hinge pin is over the lift cylinder's stroke, by closed-chain kinematics.
# `python docs/scripts/bucket_height.py MACHINE.usda [PICTURE.png]` with a wheel loader that `yellowiron build` wrote.

# %%
import sys

import matplotlib.pyplot as plt
import numpy as np

import yellowiron as yi

machine_file = sys.argv[1] if len(sys.argv) > 1 else "out/wheel_loader/wheel_loader.usda"
picture = sys.argv[2] if len(sys.argv) > 2 else "out/bucket_height.png"

# %% The machine as a mechanism: bodies, joints, actuators, sites. Metres and radians from the drawn pose.
mechanism = yi.read_mechanism(machine_file)
chain = yi.ClosedChain(mechanism)
boom = next(a for a in mechanism.actuators if a.name == "boom").joints[0].joint
hinge = next(site for site in mechanism.sites if site.name == "hinge_pin")
slide = mechanism.joint(boom)

# %% The loops solved at every stroke; a displacement (4, 4) carries points from where they are drawn.
strokes = np.linspace(slide.lower, slide.upper, 60)
states = chain.sweep({boom: strokes})
heights = [(chain.displacement(state, hinge.body) @ [*hinge.position, 1.0])[2] for state in states]

# %%
figure, axes = plt.subplots(figsize=(6.0, 4.0), layout="constrained")
axes.plot(1e3 * (strokes[: len(heights)] - slide.lower), heights)
axes.set(xlabel="lift cylinder stroke from closed (mm)", ylabel="hinge pin height (m)", title=mechanism.name)
axes.grid(alpha=0.3)
figure.savefig(picture, dpi=120)
print(f"{min(heights):.3f} m to {max(heights):.3f} m: {picture}")
