/** A typed number; comma or real minus are as good as point and hyphen. Groups of three may be set apart. */
export function parseNumber(text: string): number | undefined {
  const plain = text
    .trim()
    .replace(/\u2212/g, "-")
    .replace(/[\s\u2009\u00a0]/g, "");
  const normal = /^[+-]?\d{1,3}(,\d{3})+(\.\d+)?$/.test(plain)
    ? plain.replace(/,/g, "")
    : plain.replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(normal) ? Number(normal) : undefined;
}
