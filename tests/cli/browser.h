// Opens pages in Chromium, if it is installed.
#pragma once

#include "cli/program.h"

#include <string>
#include <vector>

namespace reflet {

/// Name of the installed browser; "" if there is none.
std::string findBrowser();

class BrowserTest : public ProgramTest {
protected:
    void SetUp() override;

    /// A file after its scripts ran, and the browser's messages. window: "WIDTH,HEIGHT", at least 500 wide.
    [[nodiscard]] Outcome openFile(const std::filesystem::path& file, const std::string& window) const;

    /// URLs that the page opened last asked of other hosts, whether or not it got an answer.
    [[nodiscard]] std::vector<std::string> foreignRequests() const;

private:
    std::string browser_;
};

/// A page with something added at its end. allowed: the page's policy lets the addition's script run.
std::string withAddition(std::string page, const std::string& addition, bool allowed = true);

/// Messages of scripts and of the page's parser.
std::vector<std::string> consoleLines(const Outcome& run);

}  // namespace reflet
