import js from "@eslint/js";
import hooks from "eslint-plugin-react-hooks";
import { readdirSync } from "node:fs";
import tseslint from "typescript-eslint";

// One direction of knowledge: app -> features/<name> -> shared.
const features = readdirSync(new URL("./src/features", import.meta.url));
const featureRules = features.map((name) => ({
  files: [`src/features/${name}/**`],
  rules: {
    "no-restricted-imports": [
      "error",
      {
        patterns: [
          { group: ["@/app/*", "**/app/*"], message: "A feature does not know the app." },
          {
            group: features.filter((other) => other !== name).map((other) => `**/features/${other}/**`),
            message: "A feature never imports another feature.",
          },
          { group: ["../../*"], message: "Use @/shared/... across folders." },
        ],
      },
    ],
  },
}));

export default tseslint.config(
  { ignores: ["dist", "src/shared/api/schema.ts"] },
  js.configs.recommended,
  ...tseslint.configs.recommended,
  {
    files: ["**/*.{ts,tsx}"],
    plugins: { "react-hooks": hooks },
    rules: {
      "react-hooks/rules-of-hooks": "error",
      "react-hooks/exhaustive-deps": "error",
      "@typescript-eslint/no-explicit-any": "error",
      "@typescript-eslint/consistent-type-imports": "error",
      "@typescript-eslint/no-unused-vars": ["error", { argsIgnorePattern: "^_" }],
      "no-restricted-globals": [
        "error",
        { name: "fetch", message: "Requests go through shared/api/client.ts." },
        { name: "WebSocket", message: "The socket belongs to shared/api/stream.ts." },
      ],
    },
  },
  { files: ["src/shared/api/**"], rules: { "no-restricted-globals": "off" } },
  {
    files: ["src/shared/**"],
    rules: {
      "no-restricted-imports": [
        "error",
        {
          patterns: [
            { group: ["**/features/**", "**/app/**"], message: "shared knows neither features nor app." },
          ],
        },
      ],
    },
  },
  ...featureRules,
  {
    files: ["*.js", "dev/**", "scripts/**"],
    languageOptions: {
      globals: {
        console: "readonly",
        process: "readonly",
        URL: "readonly",
        Buffer: "readonly",
        setTimeout: "readonly",
        setInterval: "readonly",
        clearInterval: "readonly",
        structuredClone: "readonly",
        document: "readonly",
      },
    },
  },
);
