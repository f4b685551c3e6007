// Validates files; prints for each its errors as a line of JSON: the place in the file and the sentence.
import { readFileSync } from "node:fs";
import validator from "gltf-validator";

for (const file of process.argv.slice(2)) {
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 0 });
  const errors = issues.messages.filter((issue) => issue.severity === 0);
  console.log(JSON.stringify({ file, errors: errors.map(({ pointer, message }) => `${pointer}: ${message}`) }));
}
