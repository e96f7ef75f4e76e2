// The subcommands of `reflet`. Each function adds one to the command line; its callback runs when it is chosen.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

void addRenderCommand(CLI::App& app);
void addTurntableCommand(CLI::App& app);
void addContactSheetCommand(CLI::App& app);
void addReferenceCommand(CLI::App& app);
void addDatasetCommand(CLI::App& app);
void addCompareCommand(CLI::App& app);
void addDefocusCommand(CLI::App& app);
void addMotionBlurCommand(CLI::App& app);
void addReportCommand(CLI::App& app);
void addBenchCommand(CLI::App& app);
void addQualifyCommand(CLI::App& app);
void addListCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);

}  // namespace reflet
