#include "cli/cli.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/base/number_text.h"
#include "cli/commands.h"
#include "cli/message.h"
#include "cli/text.h"
#include "cli/values.h"

namespace clearway::cli {
namespace {

constexpr char kFooter[] =
    "Start a server with clearway-server, then for example\n"
    "  clearway replay sim:crossing\n"
    "  clearway objects\n"
    "  clearway occupancy --slice 0.5 --time +1.5\n"
    "'clearway COMMAND --help' shows a command's flags and an example.";

void AddAllCommands(Cli& cli) {
  AddSimulate(cli);
  AddInfo(cli);
  AddRecord(cli);
  AddEvaluate(cli);
  AddReplay(cli);
  AddStatus(cli);
  AddObjects(cli);
  AddOccupancy(cli);
  AddCheck(cli);
  AddPlan(cli);
  AddExport(cli);
  AddLoadPrior(cli);
  AddClearRegion(cli);
  AddKeepOut(cli);
  AddReset(cli);
  AddServerInfo(cli);
  AddToken(cli);
  AddBench(cli);
}

// CLI11 takes 0x10 for 16 and 010 for 8.
std::string WhyNotDecimal(const std::string& text) {
  const std::size_t first = text.find_first_not_of("+-");
  const bool zero = first != std::string::npos && text[first] == '0' && first + 1 < text.size();
  const char next = zero ? text[first + 1] : '.';
  if (next == '.' || next == 'e' || next == 'E') return "";
  return absl::StrCat("expected a decimal number without leading zeros, not '", text, "'");
}

void RefuseOtherNumbersThanDecimal(CLI::App& app) {
  for (CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
    for (CLI::Option* const option : command->get_options()) {
      const std::string type = option->get_type_name();
      const bool number = type == "INT" || type == "UINT" || type == "FLOAT" || type == "ID";
      if (number) option->check(CLI::Validator(WhyNotDecimal, ""));
    }
  }
}

// The exit code of what went well, unless its output did not get out.
int Done(const Terminal& terminal) {
  if (terminal.out.flush()) return kExitOk;
  terminal.err << "clearway: the output cannot be written (disk full?)\n";
  return kExitFailed;
}

std::string CommandLine(int argc, const char* const* argv) {
  std::string line = "clearway";
  for (int i = 1; i < argc; ++i) absl::StrAppend(&line, " ", ShellQuoted(argv[i]));
  return line;
}

// Help and version go to `out`, complaints to `err`.
int Explain(const CLI::App& app, const CLI::ParseError& error, const Terminal& terminal) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    app.exit(error, terminal.out, terminal.err);
    return Done(terminal);
  }
  std::string command = "clearway", message = error.what();
  for (const CLI::App* chosen : app.get_subcommands()) command += " " + chosen->get_name();
  // What is not known comes before what is missing, as that may just be misspelt.
  const std::vector<std::string> unknown = app.remaining(/*recurse=*/true);
  const auto flag =
      std::ranges::find_if(unknown, [](const auto& w) { return w.starts_with("-") && w != "--"; });
  if (flag != unknown.end()) {
    const bool after = std::ranges::count(unknown, "--") > 0;
    const bool list = flag->find(',') != std::string::npos;  // such as -inf,0,0
    message = list    ? "'" + *flag + "' is neither a flag nor a list of finite numbers"
              : after ? *flag + " comes after --, so it is not read as a flag"
                      : "there is no flag " + *flag;
  }
  terminal.err << "clearway: " << message << "\nRun '" << command << " --help' for its usage.\n";
  return kExitUsage;
}

}  // namespace

CLI::App* AddCommand(Cli& cli, const std::string& name, const std::string& summary,
                     const std::string& examples, std::function<absl::Status()> run) {
  CLI::App* command = cli.app.add_subcommand(name, summary);
  command->footer("Examples:\n" + examples);
  command->get_formatter()->column_width(34);
  command->callback([&cli, run = std::move(run)] { cli.action = run; });
  return command;
}

CLI::Validator NotNegative() {
  return CLI::Validator(
      [](const std::string& text) {
        std::uint64_t ignored = 0;
        if (absl::SimpleAtoi(text, &ignored)) return std::string();
        return absl::StrCat("expected a whole number from 0 to ",
                            std::numeric_limits<std::uint64_t>::max(), ", not '", text, "'");
      },
      "");
}

CLI::Validator Between(double low, double high) {
  const auto check = [low, high](const std::string& text) {
    const auto number = ParseFinite(text);
    if (number.ok() && *number >= low && *number <= high) return std::string();
    return absl::StrCat(text, " is not between ", NumberText(low), " and ", NumberText(high));
  };
  return CLI::Validator(check, "");
}

int RunCli(int argc, const char* const* argv, Terminal& terminal) {
  CLI::App app("Clearway: is this robot state free at that time? A client of clearway-server.",
               "clearway");
  app.set_version_flag("--version", "clearway " CLEARWAY_VERSION);
  app.require_subcommand(0, 1);
  app.footer(kFooter);
  Cli cli{app, terminal, CommandLine(argc, argv), nullptr};
  AddAllCommands(cli);
  RefuseOtherNumbersThanDecimal(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return Explain(app, error, terminal);
  }
  if (!cli.action) {
    terminal.err << "clearway: give a command; 'clearway --help' lists them\n";
    return kExitUsage;
  }
  const absl::Status status = cli.action();
  if (status.ok()) return Done(terminal);
  terminal.out.flush();
  terminal.err << "clearway: " << MessageFor(status) << "\n";
  return IsUsageError(status) ? kExitUsage : kExitFailed;
}

}  // namespace clearway::cli
