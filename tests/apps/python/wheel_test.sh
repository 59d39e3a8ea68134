#!/bin/sh
# wheel_test.sh CMAKE BUILD PYTHON WHEEL: makes the wheel, unpacks it, which checks every file by the wheel's record, and imports what came out.
set -eu
"$1" --build "$2" --target wheel
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$3" -m wheel unpack --dest "$folder" "$4"
cd "$folder"
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$(ls -d "$folder"/boresight-*) "$3" -c '
import boresight, importlib.metadata
assert boresight.__file__.startswith("'"$folder"'"), boresight.__file__
assert importlib.metadata.version("boresight") == boresight.__version__
print(boresight.__version__, boresight.__file__)
'
