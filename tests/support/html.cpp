// A minimal HTML parser.
#include "support/html.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <regex>

namespace reflet::test {

namespace {

bool isVoid(const std::string& name) {
    constexpr std::array<std::string_view, 5> names{"meta", "link", "img", "input", "br"};
    return std::ranges::find(names, name) != names.end();
}

// NAME, then any number of NAME="VALUE" or NAME.
Element parseTag(const std::string& tag, std::vector<std::string>& mistakes) {
    static const std::regex whole(R"re([a-zA-Z][a-zA-Z0-9]*(\s+[a-zA-Z:-]+(="[^"<]*")?)*\s*)re");
    static const std::regex attribute(R"re(\s([a-zA-Z:-]+)(="([^"]*)")?)re");
    if (!std::regex_match(tag, whole)) {
        mistakes.push_back("a broken tag: " + tag);
    }
    Element element{tag.substr(0, tag.find_first_of(" \n")), {}, {}};
    for (std::sregex_iterator i(tag.begin(), tag.end(), attribute), end; i != end; ++i) {
        if (!element.attributes.emplace((*i)[1], (*i)[3]).second) {
            mistakes.push_back("an attribute twice: " + tag);
        }
    }
    return element;
}

}  // namespace

std::vector<Element> Html::named(std::string_view name) const {
    std::vector<Element> found;
    std::ranges::copy_if(elements, std::back_inserter(found), [&](const Element& e) { return e.name == name; });
    return found;
}

Html parseHtml(std::string_view text) {
    Html html;
    std::vector<std::string> open;
    size_t at = text.find('<', text.starts_with("<!DOCTYPE html>") ? 1 : 0);
    while (at != std::string_view::npos) {
        const size_t end = std::min(text.find('>', at), text.size());
        std::string tag(text.substr(at + 1, end - at - 1));
        const bool closed = tag.ends_with('/');
        if (tag.starts_with('/')) {
            if (open.empty() || open.back() != tag.substr(1)) {
                html.mistakes.push_back("closed, but not open: " + tag);
                return html;
            }
            open.pop_back();
            at = text.find('<', end);
            continue;
        }
        html.elements.push_back(parseTag(closed ? tag.substr(0, tag.size() - 1) : tag, html.mistakes));
        Element& element = html.elements.back();
        const bool raw = element.name == "script" || element.name == "style";
        at = raw ? text.find("</" + element.name, end) : text.find('<', end);
        element.text = text.substr(std::min(end + 1, text.size()), at - std::min(end + 1, text.size()));
        if (!closed && !isVoid(element.name)) {
            open.push_back(element.name);
        }
    }
    std::ranges::transform(open, std::back_inserter(html.mistakes), [](const auto& name) { return "open: " + name; });
    return html;
}

}  // namespace reflet::test
