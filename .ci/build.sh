# What both commands begin with: install what is missing, configure, build. Sourced from the repository's root.
set -euo pipefail

. .ci/install.sh
install_packages .ci/packages.txt

cmake --preset developer
