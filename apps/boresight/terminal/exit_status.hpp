// What the program's exit status says.
#pragma once

namespace boresight::app {

inline constexpr int kDone = 0;
inline constexpr int kAnswerIsNo = 1;  // done, and the answer is no: a singular pose, a requirement not met
inline constexpr int kBadInput = 2;
inline constexpr int kFailed = 3;  // the computation or the writing of its results failed
inline constexpr int kInterrupted = 130;

}  // namespace boresight::app
