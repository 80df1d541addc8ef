// Two builds are made of this app, each into a folder of its own.
export default { distDir: process.env.DIST };
