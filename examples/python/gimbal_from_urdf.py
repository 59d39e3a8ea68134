"""A gimbal from its URDF to its pointing budget.

    PYTHONPATH=build/release/python python3 examples/python/gimbal_from_urdf.py [FOLDER]

FOLDER, where gimbal.toml, the budget and its report are kept; otherwise nothing is.
"""

import os
import shutil
import sys
import tempfile

import boresight

# What URDF cannot say: the play of the bearings, the zeros of the encoders.
PLAY = """
[[clearance]]
joint = "tilt"
journal = "camera"
radial = "0.01 mm"
axial = "0.02 mm"
journal_radius = "4 mm"
cap_radius = "6 mm"
sleeve_length = "30 mm"
axes = "free"
  [clearance.contact]
  law = "flores"
  restitution = 0.85
  young = ["206 GPa", "72 GPa"]
  poisson = [0.3, 0.33]
  density = "2700 kg/m^3"
  minimum_impact_speed = "1 mm/s"
  [clearance.friction]
  law = "modified-coulomb"
  coefficient = 0.08
  static_speed = "0.1 mm/s"
  dynamic_speed = "1 mm/s"

[[error]]
name = "pan.zero"
drive = "pan"
value = "20 arcsec"

[[error]]
name = "tilt.zero"
drive = "tilt"
value = "-30 arcsec"
"""

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "from-urdf")

own = None if len(sys.argv) > 1 else tempfile.TemporaryDirectory()
folder = sys.argv[1] if own is None else own.name
os.makedirs(folder, exist_ok=True)
mechanism = os.path.join(folder, "gimbal.toml")
boresight.import_mechanism(os.path.join(HERE, "gimbal.urdf"), mechanism, boresight="optical_frame:z",
                           drive="pan=0.4*sin(2*t); tilt=0.3*sin(3*t)", duration="0.5 s")

with open(mechanism, "a", encoding="utf-8") as file:
    file.write(PLAY)
shutil.copy(os.path.join(HERE, "budget.toml"), folder)

budget = boresight.budget(os.path.join(folder, "budget.toml"), rung="quasistatic", out=os.path.join(folder, "budget"))
ARCSEC = 3.14159265358979 / 180 / 3600
for level in budget.summary["requirements"]:
    print(f"{level['index']} at {level['probability']:.0%}: {level['value'] / ARCSEC:.0f} arcsec "
          f"({level['low'] / ARCSEC:.0f} to {level['high'] / ARCSEC:.0f}), limit {level['limit'] / ARCSEC:.0f}: "
          f"{'met' if level['met'] else 'not met'}")
for part in budget.summary["contributions"]:
    print(f"  {part['share']:6.1%}  {part['name']}")
if own is None:
    budget.report(os.path.join(folder, "report.html"))
