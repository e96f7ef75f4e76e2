#include "cli/browser.h"

#include <sstream>

namespace reflet {

std::string findBrowser() {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
        if (isInstalled(name)) {
            return name;
        }
    }
    return "";
}

void BrowserTest::SetUp() {
    browser_ = findBrowser();
    if (browser_.empty()) {
        GTEST_SKIP() << "no chromium, chromium-browser or google-chrome in PATH";
    }
}

// `timeout` also ends its child processes.
Outcome BrowserTest::openFile(const std::filesystem::path& file, const std::string& window) const {
    Arguments all{"--kill-after=5",
                  "60",
                  browser_,
                  "--headless",
                  "--no-sandbox",
                  "--disable-gpu",
                  "--disable-dev-shm-usage",
                  "--no-first-run",
                  "--disable-background-networking",
                  "--disable-component-update",
                  "--disable-extensions",
                  "--enable-logging=stderr",
                  "--dump-dom",
                  "--virtual-time-budget=5000",
                  "--window-size=" + window};
    all.push_back("--user-data-dir=" + path("profile").string());
    all.push_back("file://" + file.string());
    return runOther("timeout", all, {{"HOME", path("").string()}, {"DBUS_SESSION_BUS_ADDRESS", "/dev/null"}});
}

std::vector<std::string> consoleLines(const Outcome& run) {
    std::vector<std::string> found;
    std::istringstream lines(run.err);
    for (std::string line; std::getline(lines, line);) {
        if (line.find("CONSOLE") != std::string::npos) {
            found.push_back(line);
        }
    }
    return found;
}

}  // namespace reflet
