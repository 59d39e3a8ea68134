# What both commands begin with: install what is missing, configure, build. Sourced from the repository's root. tests=OFF: of the program alone,
# unless the build folder has been configured with its tests before.
set -euo pipefail

. .ci/install.sh
install_packages .ci/packages.txt

tests=${tests:-ON}
if [ "$tests" = OFF ] && [ -e build/release/CMakeCache.txt ]; then
  cmake --preset developer
else
  [ "$tests" = OFF ] || install_packages .ci/packages.test.txt
  cmake --preset developer -DBORESIGHT_TESTS="$tests" -DBORESIGHT_BENCHMARKS="$tests" -DBORESIGHT_PYTHON="$tests"
fi
