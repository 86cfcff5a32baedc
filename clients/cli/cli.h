// The command line tool `clearway`: subcommands, what they write to, and exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace clearway::cli {

inline constexpr int kExitOk = 0;
inline constexpr int kExitFailed = 1;  // what was asked for could not be done
inline constexpr int kExitUsage = 2;   // the command line makes no sense

// Where a command reads and writes. Answers go to `out`, everything else to `err`.
struct Terminal {
  std::istream& in;
  std::ostream& out;
  std::ostream& err;
  bool err_is_terminal = false;  // progress may then redraw its line
  int columns = 100;             // width of `out`
};

// Passed to each subcommand when it is set up. Used by one thread.
struct Cli {
  CLI::App& app;
  Terminal& terminal;
  std::string command_line;              // as a shell takes it, with the program's short name
  std::function<absl::Status()> action;  // of the subcommand that was chosen
};

// Adds a subcommand with an example below its help. `run` is called once its flags are parsed.
CLI::App* AddCommand(Cli& cli, const std::string& name, const std::string& summary,
                     const std::string& examples, std::function<absl::Status()> run);

// Parses and runs one command line; returns the exit code.
int RunCli(int argc, const char* const* argv, Terminal& terminal);

// Refuses what is no number from `low` to `high`, NaN above all. (CLI11's own ranges let NaN pass.)
CLI::Validator Between(double low, double high);
// Refuses what is no whole number from 0 to 2^64 - 1: negative ones would pass for large ones.
CLI::Validator NotNegative();

// Adds a flag whose text is read by `parse`; what that refuses is a usage error with its message.
// `Target` is T or std::optional<T>.
template <class Target, class T>
CLI::Option* AddParsed(CLI::App* command, const std::string& flag, Target* value,
                       absl::StatusOr<T> (*parse)(const std::string&), const std::string& help) {
  return command
      ->add_option(
          flag,
          [value, parse](const CLI::results_t& texts) {
            auto parsed = parse(texts.back());
            if (parsed.ok()) *value = *std::move(parsed);
            return parsed.ok();
          },
          help)
      ->check(
          [parse](const std::string& text) { return std::string(parse(text).status().message()); });
}

// The same for a flag that may be given several times.
template <class T>
CLI::Option* AddParsedList(CLI::App* command, const std::string& flag, std::vector<T>* values,
                           absl::StatusOr<T> (*parse)(const std::string&),
                           const std::string& help) {
  return command
      ->add_option(
          flag,
          [values, parse](const CLI::results_t& texts) {
            for (const std::string& text : texts) {
              auto parsed = parse(text);
              if (!parsed.ok()) return false;
              values->push_back(*std::move(parsed));
            }
            return true;
          },
          help)
      ->check(
          [parse](const std::string& text) { return std::string(parse(text).status().message()); })
      ->take_all()
      ->allow_extra_args(false);
}

}  // namespace clearway::cli
