// Ctrl-C and a polite kill: the first one only raises a flag that long work looks at, so that what was
// computed is still written as whole files; the second one ends the program at once.
#pragma once

namespace boresight::app {

// SIGINT and SIGTERM from now on only set the flag.
void catch_interruptions();

// Whether one of them has arrived.
bool interrupted();

}  // namespace boresight::app
