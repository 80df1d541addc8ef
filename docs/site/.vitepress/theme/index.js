// The theme: VitePress's own, with other fonts, colours and a few components.

import "@fontsource-variable/instrument-sans/index.css";
import "@fontsource-variable/jetbrains-mono/index.css";
import DefaultTheme from "vitepress/theme-without-fonts";
import "./style.css";
import "./landing/landing.css";
import "./playground/playground.css";

export default DefaultTheme;
