// boresight montecarlo on several ranks.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "montecarlo_program.hpp"

namespace boresight::app {
namespace montecarlo_ranks_program_test {

#ifdef BORESIGHT_MPIEXEC

class MonteCarloRanks : public MonteCarloProgram {
 protected:
  int under_mpirun(int ranks, const std::vector<std::string>& arguments) const {
    std::string command = "cd '" + folder_.string() +
                          "' && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" BORESIGHT_MPIEXEC
                          "' --oversubscribe -np " +
                          std::to_string(ranks) + " '" BORESIGHT_PROGRAM "'";
    for (const std::string& argument : arguments) command += " '" + argument + "'";
    const int status = std::system((command + " > mpi.out 2> mpi.err").c_str());
    return WEXITSTATUS(status);
  }
};

TEST_F(MonteCarloRanks, TwoRanksGiveTheTableOfOneProcess) {
  const std::string whole = csv_of("study.toml", "whole");
  EXPECT_EQ(under_mpirun(2, quick("study.toml", "out", {"--jobs", "1"})), 0) << text("mpi.err");
  EXPECT_EQ(samples_of("out"), whole);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/samples.1.db")) << "shards are merged";
}

TEST_F(MonteCarloRanks, ARankThatIsKilledCostsOnlyWhatItHadNotStored) {
  study("long.toml", 25000);
  const std::string whole = csv_of("long.toml", "whole");
  // The shell of rank 1 kills its program from outside once samples are being stored.
  const std::string script = (folder_ / "rank.sh").string();
  std::ofstream(script)
      << "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then '" BORESIGHT_PROGRAM
         "' \"$@\" & child=$!; for k in $(seq 200); do ls out/*.db > /dev/null 2>&1 && break; sleep 0.05; done; "
         "sleep 0.2; kill -9 $child; wait $child; else exec '" BORESIGHT_PROGRAM "' \"$@\"; fi\n";
  std::string command = "cd '" + folder_.string() +
                        "' && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" BORESIGHT_MPIEXEC
                        "' --oversubscribe -np 2 bash rank.sh";
  for (const std::string& argument : quick("long.toml", "out", {"--jobs", "1"})) command += " '" + argument + "'";
  std::system((command + " > mpi.out 2> mpi.err").c_str());
  EXPECT_EQ(under_mpirun(2, quick("long.toml", "out", {"--jobs", "1", "--resume"})), 0) << text("mpi.err");
  EXPECT_EQ(samples_of("out"), whole);
}

TEST_F(MonteCarloRanks, AMistakeIsSaidOnce) {
  study("bad.toml", 100, "desing = \"lhs\"");
  EXPECT_EQ(under_mpirun(2, quick("bad.toml", "out")), 2);
  const std::string said = text("mpi.err");
  EXPECT_NE(said.find("did you mean design?"), std::string::npos) << said;
  EXPECT_EQ(said.find("did you mean design?"), said.rfind("did you mean design?")) << said;
}

#endif

}  // namespace montecarlo_ranks_program_test
}  // namespace boresight::app
