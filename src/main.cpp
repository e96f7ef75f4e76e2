// Entry point: names the subcommands.
#include "cli/commands.h"
#include "cli/program.h"
#ifdef REFLET_WINDOW
#include "view/view_command.h"
#endif

int main(int argc, char** argv) {
    constexpr reflet::AddCommand commands[] = {
        reflet::addRenderCommand,
#ifdef REFLET_WINDOW
        reflet::addViewCommand,
#endif
        reflet::addTurntableCommand, reflet::addContactSheetCommand, reflet::addReferenceCommand,
        reflet::addDatasetCommand,   reflet::addDefocusCommand,      reflet::addMotionBlurCommand,
        reflet::addCompareCommand,   reflet::addBenchCommand,        reflet::addReportCommand,
        reflet::addQualifyCommand,   reflet::addListCommand,         reflet::addInfoCommand};
    return reflet::runProgram(argc, argv, commands);
}
