// How much a thread counts when more want to run than there are processors. Linux only; where the
// system refuses, nothing changes.
#pragma once

namespace clearway {

// Lets the calling thread, and the threads that it starts from now on, run as soon as they have
// something to do, for short turns, and thereby before others that are as important. From Linux
// 6.12 on: https://docs.kernel.org/scheduler/sched-eevdf.html.
void PreferShortTurns();

// Gives the calling thread a smaller share, from 0 (as others) to 19, in turns of the usual length.
void GiveWay(int niceness);

}  // namespace clearway
