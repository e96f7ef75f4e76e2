// Validates all glTF files of a folder by Khronos' glTF-Validator. One line for each, sorted by name:
// NAME<tab>CODE POINTER;CODE POINTER... of its errors.
// usage: node gltf_validator.js VALIDATOR_PACKAGE FOLDER
"use strict";
const fs = require("fs");
const path = require("path");

const [validator, folder] = [require(path.resolve(process.argv[2])), process.argv[3]];
const read = (name) => new Uint8Array(fs.readFileSync(path.join(folder, name)));

async function errorsOf(name) {
    try {
        const report = await validator.validateBytes(read(name), {
            uri: name,
            maxIssues: 0,
            externalResourceFunction: async (uri) => read(decodeURIComponent(uri)),
        });
        return report.issues.messages.filter((m) => m.severity === 0).map((m) => `${m.code} ${m.pointer ?? ""}`);
    } catch (problem) {  // not even a JSON document
        return [`UNREADABLE ${String(problem).split("\n")[0]}`];
    }
}

(async () => {
    for (const name of fs.readdirSync(folder).sort()) {
        if (/\.(gltf|glb)$/.test(name)) {
            console.log(`${name}\t${(await errorsOf(name)).join(";")}`);
        }
    }
})();
