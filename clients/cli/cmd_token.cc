// clearway token: who may do what on a server.
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "clearway/base/secret_file.h"
#include "clearway/wire/token_table.h"
#include "cli/commands.h"

namespace clearway::cli {
namespace {

constexpr std::uint64_t kMaxBytes = 1 << 20;
constexpr char kReload[] =
    "A running server reads the file again on SIGHUP (pkill -HUP clearway-server).\n";
constexpr char kHeader[] =
    "# Who may do what on a Clearway server: NAME ROLE sha256:HEX, or NAME ROLE certificate.\n"
    "# Written by 'clearway token'; its tokens cannot be read from here.\n";

struct Flags {
  std::string name;
  std::optional<Role> role;
  std::string file;
};

absl::StatusOr<Role> ReadRole(const std::string& text) {
  const std::optional<Role> role = ParseRole(text);
  if (role) return *role;
  return absl::InvalidArgumentError(absl::StrCat("expected read, push or admin, not '", text, "'"));
}

absl::Status Add(const Flags& flags, const Terminal& terminal) {
  absl::StatusOr<std::string> text = ReadSecretFile(flags.file, kMaxBytes);
  if (absl::IsNotFound(text.status())) text = std::string(kHeader);
  if (!text.ok()) return text.status();
  const absl::StatusOr<NewToken> made = MakeToken(flags.name, *flags.role);
  if (!made.ok()) return made.status();
  if (!text->empty() && text->back() != '\n') *text += '\n';
  absl::StrAppend(&*text, made->line, "\n");
  if (const auto table = TokenTable::Parse(flags.file, *text); !table.ok()) return table.status();
  if (auto status = WriteSecretFile(flags.file, *text); !status.ok()) return status;
  terminal.out << made->token << "\n";
  terminal.err << "This is the only time that the token is shown. Clients take it from a file:\n"
                  "clearway status --token-file FILE. "
               << kReload;
  return absl::OkStatus();
}

absl::Status Revoke(const Flags& flags, const Terminal& terminal) {
  const absl::StatusOr<std::string> text = ReadSecretFile(flags.file, kMaxBytes);
  if (!text.ok()) return text.status();
  if (const auto table = TokenTable::Parse(flags.file, *text); !table.ok()) return table.status();
  std::vector<std::string> kept;
  bool found = false;
  for (const absl::string_view line : absl::StrSplit(*text, '\n')) {
    const std::vector<absl::string_view> words =
        absl::StrSplit(line, absl::ByAnyChar(" \t"), absl::SkipEmpty());
    const bool revoked = !words.empty() && words[0] == flags.name;
    if (!revoked) kept.emplace_back(line);
    found = found || revoked;
  }
  if (!found) {
    return absl::NotFoundError(absl::StrCat(flags.file, ": there is no \"", flags.name, "\""));
  }
  if (auto status = WriteSecretFile(flags.file, absl::StrJoin(kept, "\n")); !status.ok()) {
    return status;
  }
  terminal.out << flags.name << " is no longer in " << flags.file << "\n";
  terminal.err << kReload;
  return absl::OkStatus();
}

absl::Status List(const Flags& flags, const Terminal& terminal) {
  const absl::StatusOr<TokenTable> table = TokenTable::Read(flags.file);
  if (!table.ok()) return table.status();
  for (const TokenEntry& entry : table->entries()) {
    terminal.out << entry.name << " " << ToText(entry.role) << " "
                 << (entry.token_hash ? "token" : "certificate") << "\n";
  }
  return absl::OkStatus();
}

using Action = absl::Status (*)(const Flags&, const Terminal&);

CLI::App* AddAction(Cli& cli, CLI::App* group, const std::string& name, const std::string& summary,
                    const std::shared_ptr<Flags>& flags, Action action) {
  CLI::App* const command = group->add_subcommand(name, summary);
  command->add_option("--tokens", flags->file, "The server's file of tokens")->required();
  command->callback([&cli, flags, action] {
    cli.action = [&cli, flags, action] { return action(*flags, cli.terminal); };
  });
  return command;
}

}  // namespace

void AddToken(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* const group = cli.app.add_subcommand("token", "Decide who may do what on a server");
  group->require_subcommand(1);
  group->footer(
      "Examples:\n"
      "  clearway token add slam --role push --tokens tokens.txt > slam.token\n"
      "  clearway-server --tokens tokens.txt\n"
      "  clearway replay sim:crossing --token-file slam.token\n"
      "  clearway token revoke slam --tokens tokens.txt");
  CLI::App* const add =
      AddAction(cli, group, "add", "Add a client and print its token, once", flags, Add);
  add->add_option("name", flags->name, "The client's name")->required();
  AddParsed(add, "--role", &flags->role, ReadRole,
            "read (ask and plan), push (also frames and objects) or admin (also reset and maps)")
      ->required();
  AddAction(cli, group, "revoke", "Take a client's access away", flags, Revoke)
      ->add_option("name", flags->name, "The client's name")
      ->required();
  AddAction(cli, group, "list", "Print names and roles", flags, List);
}

}  // namespace clearway::cli
