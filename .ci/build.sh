# What both commands begin with: install what is missing, configure, build. Sourced from the repository's root. tests=OFF: of the program alone,
# unless the build folder has been configured with its tests before.
set -euo pipefail

. .ci/install.sh
install_packages .ci/packages.txt

tests=${tests:-ON}
# A new build folder compiles the files of a library in batches, which takes less time; one that is there stays as it is. A whole library
# at once (0) where each compiler that ninja starts may have 4 GB. For who changes files: cmake --preset developer -DCMAKE_UNITY_BUILD=OFF.
new=()
if ! [ -e build/release/CMakeCache.txt ]; then
  batch=12
  [ "$(awk '/^MemTotal/ {print int($2 / 1e6)}' /proc/meminfo)" -lt $((4 * ($(nproc) + 2))) ] || batch=0
  new=(-DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=$batch)
fi
if [ "$tests" = OFF ] && [ "${#new[@]}" -eq 0 ]; then
  cmake --preset developer
else
  [ "$tests" = OFF ] || install_packages .ci/packages.test.txt
  cmake --preset developer -DBORESIGHT_TESTS="$tests" -DBORESIGHT_BENCHMARKS="$tests" -DBORESIGHT_PYTHON="$tests" \
    ${new[@]+"${new[@]}"}
fi
