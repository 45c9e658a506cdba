// Checks GLB files with the validator of glTF (Khronos Group): `node validate-glb.js FOLDER FILE...`. Downloads the
// validator into the folder. Exit code 1 if a file has errors or warnings.

const { execFileSync } = require("node:child_process");
const { existsSync, mkdirSync, readFileSync, renameSync, rmSync } = require("node:fs");
const { join, resolve } = require("node:path");

const PACKAGE = "https://registry.npmjs.org/gltf-validator/-/gltf-validator-2.0.0-dev.3.10.tgz";

const [folder, ...files] = process.argv.slice(2);
const place = resolve(folder, "gltf-validator");
if (!existsSync(place)) {
  // A download that fails leaves no folder that looks complete.
  const part = `${place}.part`;
  rmSync(part, { recursive: true, force: true });
  mkdirSync(part, { recursive: true });
  execFileSync("curl", ["-fsSL", "-o", join(part, "package.tgz"), PACKAGE], { stdio: "inherit" });
  execFileSync("tar", ["xzf", join(part, "package.tgz"), "-C", part, "--strip-components", "1"]);
  renameSync(part, place);
}
const validator = require(join(place, "index.js"));

async function check(file) {
  const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(file)));
  console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings; ${info.totalTriangleCount} triangles, ${info.animationCount} animations`);
  issues.messages.slice(0, 5).forEach((message) => console.log(`  ${message.code} at ${message.pointer}: ${message.message}`));
  return issues.numErrors + issues.numWarnings;
}

Promise.all(files.map(check)).then((counts) => process.exit(counts.some((count) => count > 0) ? 1 : 0));
