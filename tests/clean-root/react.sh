# The npm package in Vite and React, from the file that npm installs alone. The page is that of its
# README, in the template of Vite.
set -eu
cd /home
npm create --yes vite@7.1.3 react -- --template react < /dev/null
cd react
npm install --no-audit --no-fund /artefacts/muslin-*.tgz three@0.187.0 @react-three/fiber@9.8.2
awk '/^```jsx$/ { inside = 1; next } /^```/ { inside = 0 } inside' node_modules/muslin/README.md > src/main.jsx
npx vite build --base ./
echo "first frame: npm in Vite and React, $(grep -c . src/main.jsx) lines"
