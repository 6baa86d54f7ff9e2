// SPDX-License-Identifier: BSD-3-Clause

// The rules for TypeScript and for the scripts of Node; `npm run lint` applies them, and so do the tests.
import js from "@eslint/js";
import globals from "globals";
import typescript from "typescript-eslint";

export default typescript.config(
  js.configs.recommended,
  typescript.configs.recommended,
  {
    languageOptions: { globals: { ...globals.browser, ...globals.node } },
    rules: {
      "no-unused-expressions": "off",
      "@typescript-eslint/no-unused-expressions": "off", // `found && show(found)` is a statement here
      "no-control-regex": "off", // control characters are looked for
      "@typescript-eslint/no-unused-vars": ["error", { argsIgnorePattern: "^_" }],
    },
  },
);
