#!/usr/bin/env python3
"""search_index.py SITE: the index of mkdocs as a script, which pages opened from a folder can load; and nothing else of
its search."""
import json
import os
import shutil
import sys

folder = os.path.join(sys.argv[1], "search")
with open(os.path.join(folder, "search_index.json"), encoding="utf-8") as file:
    docs = json.load(file)["docs"]
shutil.rmtree(folder)
entries = [[d["location"], d["title"], " ".join(d["text"].split())] for d in docs]
with open(os.path.join(sys.argv[1], "search_index.js"), "w", encoding="utf-8") as file:
    file.write("window.searchIndex = " + json.dumps(entries, ensure_ascii=False).replace("</", "<\\/") + ";\n")
