#include "cli/browser.h"

#include "base/sha256.h"

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

constexpr const char* netLog = "net.json";

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
                  "--host-resolver-rules=MAP * ~NOTFOUND",
                  "--window-size=" + window};
    all.push_back("--user-data-dir=" + path("profile").string());
    all.push_back("--log-net-log=" + path(netLog).string());
    all.push_back("file://" + file.string());
    return runOther("timeout", all, {{"HOME", path("").string()}, {"DBUS_SESSION_BUS_ADDRESS", "/dev/null"}});
}

// The log has one event in each line. What the browser asks for itself has another initiator.
std::vector<std::string> BrowserTest::foreignRequests() const {
    constexpr std::string_view field = R"("url":")";
    std::istringstream lines(read(netLog));
    std::vector<std::string> found;
    size_t events = 0;
    for (std::string line; std::getline(lines, line); ++events) {
        const size_t at = line.find(field);
        if (line.find(R"("initiator":"null")") == std::string::npos || at == std::string::npos) {
            continue;
        }
        const std::string url = line.substr(at + field.size(), line.find('"', at + field.size()) - at - field.size());
        if (!url.starts_with("file:") && !url.starts_with("data:")) {
            found.push_back(url);
        }
    }
    EXPECT_GT(events, 10U) << "the browser wrote no log of its requests";
    return found;
}

std::string withAddition(std::string page, const std::string& addition, bool allowed) {
    constexpr std::string_view begin = "<script>";
    constexpr std::string_view scripts = "script-src ";
    constexpr std::string_view end = "</body>";
    page.replace(page.rfind(end), end.size(), addition);
    if (!allowed) {
        return page;
    }
    const size_t first = addition.find(begin) + begin.size();
    const std::string script = addition.substr(first, addition.find("</script>") - first);
    const size_t at = page.find(scripts);
    EXPECT_NE(at, std::string::npos) << "the page has no policy";
    return at == std::string::npos ? page : page.insert(at + scripts.size(), "'sha256-" + sha256Base64(script) + "' ");
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
