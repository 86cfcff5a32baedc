// The subcommands, one file each.
#pragma once

#include "cli/cli.h"

namespace clearway::cli {

// Sources of frames, no server needed.
void AddSimulate(Cli& cli);
void AddInfo(Cli& cli);
void AddRecord(Cli& cli);
void AddEvaluate(Cli& cli);

// Files of a server, no server needed.
void AddToken(Cli& cli);

// Everything below talks to a server.
void AddReplay(Cli& cli);
void AddStatus(Cli& cli);
void AddObjects(Cli& cli);
void AddOccupancy(Cli& cli);
void AddCheck(Cli& cli);
void AddPlan(Cli& cli);
void AddExport(Cli& cli);
void AddLoadPrior(Cli& cli);
void AddClearRegion(Cli& cli);
void AddKeepOut(Cli& cli);
void AddReset(Cli& cli);
void AddServerInfo(Cli& cli);
void AddBench(Cli& cli);

}  // namespace clearway::cli
