export { newest, useHeard, type Heard } from "@/shared/live";
