// One line on a terminal for long work that has nothing else to show: "following the ideal motion: 43 %". Where it is heard that
// the work is no longer wanted, it ends by throwing Interrupted (boresight/mechanism/interruption.hpp).
#pragma once

namespace boresight::app {

// The library's long work is watched from now on. Call from the main thread, whose work is shown.
void watch_long_work();
void show_work(bool wanted);
// Takes the line off the terminal, before something else is printed.
void clear_work_line();

// Whether a signal has arrived that interrupted() has told nobody of. Who was told keeps what was reached and ends in good order, and
// what is still computed for that is not cut short.
bool interruption_unheard();

}  // namespace boresight::app
