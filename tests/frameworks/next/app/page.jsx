// A server component: it plays the script on the server for each request.

import init, { Cloth } from "muslin";
import { play } from "../../shared.mjs";
import Client from "./client.jsx";

export const dynamic = "force-dynamic";

export default async function Page() {
  return <main><p id="server">{await play(init, Cloth)}</p><Client /></main>;
}
