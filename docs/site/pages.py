#!/usr/bin/env python3
"""Collects the pages of the site: pages.py WORK SITE [--gallery] [--api]

Copies every page that README.md leads to, and the files that these link to, to WORK/pages, in the repository's layout.
A folder that is linked to and has no page gets a list of its files. Writes WORK/mkdocs.yml."""
import json
import os
import re
import shutil
import sys

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
LINK = re.compile(r"(!?\[[^\]]*\]\()([^)\s#]+)((?:#[^)\s]*)?\))")
FENCE = re.compile(r"^(```[\s\S]*?^```|(?: {4}[^\n]*\n)+)|`[^`\n]+`", re.MULTILINE)
NAVIGATION = [
    ("Start", ["README.md", "docs/features.md", "docs/tutorial.md", "docs/README.md"]),
    ("Manual", ["docs/rendering.md", "docs/window.md", "docs/sequences.md", "docs/films.md", "docs/many-machines.md", "docs/reference.md",
                "docs/report.md", "docs/bench.md", "docs/settings.md", "docs/files.md", "docs/view-files.md", "docs/datasets.md", "docs/python.md"]),
    ("Library", ["docs/library.md", "docs/upgrading.md", "docs/conventions.md", "docs/architecture.md"]),
    ("Methods", ["docs/methods/README.md"]),
    ("Measured", ["docs/accuracy.md", "docs/hard-cases.md", "docs/motion.md", "docs/performance.md", "docs/gpu.md",
                  "docs/gpu-model.md", "docs/devices.md"]),
    ("Project", ["CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "docs/fuzzing.md", "docs/site.md"]),
]


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def listing(folder):
    """A page of the folder's files."""
    names = sorted(n for n in os.listdir(os.path.join(ROOT, folder)) if not n.startswith((".", "__")))
    lines = [f"# {folder}/", ""]
    for name in names:
        inside = os.path.isdir(os.path.join(ROOT, folder, name))
        lines.append(f"- [{name}{'/' if inside else ''}]({name}{'/README.md' if inside else ''})")
    return "\n".join(lines) + "\n"


class Pages:
    def __init__(self, work):
        self.work = work
        self.known = set()
        self.waiting = ["README.md"]

    def target(self, page, link):
        """The file that a page's link leads to, as a path in the repository; None: another host, or nothing there."""
        if re.match(r"[a-z]+:|/", link):
            return None
        path = os.path.normpath(os.path.join(os.path.dirname(page), link))
        full = os.path.join(ROOT, path)
        listed = os.path.basename(path) == "README.md" and os.path.isdir(os.path.dirname(full))
        if path.startswith("..") or not (listed or os.path.exists(full)):
            sys.exit(f"{page}: links to {link}, which does not exist")
        return os.path.join(path, "README.md") if os.path.isdir(full) else path

    def page(self, path):
        text = read(path) if os.path.exists(os.path.join(ROOT, path)) else listing(os.path.dirname(path))
        kept = []

        def hide(block):
            kept.append(block.group(0))
            return f"\0{len(kept) - 1}\0"

        def follow(link):
            found = self.target(path, link.group(2))
            if found is None:
                return link.group(0)
            self.waiting.append(found)
            relative = os.path.relpath(found, os.path.dirname(path) or ".")
            return link.group(1) + relative + link.group(3)

        text = LINK.sub(follow, FENCE.sub(hide, text))
        return re.sub("\0(\\d+)\0", lambda m: kept[int(m.group(1))], text)

    def collect(self):
        while self.waiting:
            path = self.waiting.pop()
            if path in self.known:
                continue
            self.known.add(path)
            copy = os.path.join(self.work, "pages", path)
            os.makedirs(os.path.dirname(copy), exist_ok=True)
            if path.endswith(".md"):
                with open(copy, "w", encoding="utf-8") as file:
                    file.write(self.page(path))
            else:
                shutil.copy(os.path.join(ROOT, path), copy)


def title(path):
    return re.search(r"^# (.*)$", read(path), re.MULTILINE).group(1).replace("`", "")


def configuration(work, site, has):
    navigation = [{group: [{title(p): p} for p in pages]} for group, pages in NAVIGATION]
    methods = sorted(n for n in os.listdir(os.path.join(ROOT, "docs/methods")) if n.endswith(".md") and n != "README.md")
    navigation[3]["Methods"] += [{title(f"docs/methods/{n}"): f"docs/methods/{n}"} for n in methods]
    # JSON is YAML.
    return json.dumps({
        "site_name": "Reflet", "docs_dir": os.path.join(work, "pages"), "site_dir": site, "use_directory_urls": False,
        "theme": {"name": None, "custom_dir": os.path.join(ROOT, "docs/site/theme")}, "nav": navigation,
        "plugins": ["search"], "markdown_extensions": ["toc", "tables", "fenced_code"],
        "extra": {"api": "--api" in has, "gallery": "--gallery" in has},
    })


def main():
    work, site = sys.argv[1:3]
    Pages(work).collect()
    with open(os.path.join(work, "mkdocs.yml"), "w", encoding="utf-8") as file:
        file.write(configuration(work, site, sys.argv[3:]))


main()
