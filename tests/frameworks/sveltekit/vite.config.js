import { sveltekit } from "@sveltejs/kit/vite";

export default { plugins: [sveltekit()], logLevel: "warn", build: { chunkSizeWarningLimit: 1000 } };
