// SPDX-License-Identifier: BSD-3-Clause

// Maps of values over places, such as slices of a workspace: small multiples with one cursor and one bar of colours.
import type { RefObject } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { Reset } from "./chart";
import { at, classColour, classes, classOf, countOf, indexOf, mapsOf, pathsOf, scaledOf, sizeOf, type Level, type Maps } from "./cells";
import type { Plot, Table } from "./data";
import { boxWithin, listen, type Spot } from "./gestures";
import { format } from "./units";
import { niceStep, ticks, type Box } from "./view";
import { boxAbout, nearer, shifted, type Range } from "./zoom";

const margin = { left: 50, right: 10, top: 4, bottom: 40 };
const gap = 16;
const [leastWidth, mostWidth, mostHeight] = [230, 640, 400]; // px

interface Place {
  i: number;
  j: number;
}

/** The gestures of a map, which has no fixed cursor. */
export const mapHint = "Drag: zoom. Shift + drag: move. Ctrl + wheel, or two fingers: zoom. Double click: show all. With the keyboard: + − 0, arrows read values.";

const wholeOf = ({ x, y }: Maps): Box => ({ left: x.low - x.pitch / 2, right: x.high + x.pitch / 2, bottom: y.low - y.pitch / 2, top: y.high + y.pitch / 2 });

/** Size of each map: as many side by side as have room and fill the last row best. */
function layoutOf(maps: Maps, width: number): { scale: number; width: number; height: number } {
  const n = maps.levels.length;
  const most = Math.max(1, Math.min(n, Math.floor((width + gap) / (leastWidth + gap))));
  const columns = Math.ceil(n / Math.ceil(n / most));
  const room = Math.min(mostWidth, Math.floor((width - gap * (columns - 1)) / columns)) - margin.left - margin.right;
  const scale = Math.min(Math.max(room, 80) / sizeOf(maps.x), mostHeight / sizeOf(maps.y));
  return { scale, width: sizeOf(maps.x) * scale + margin.left + margin.right, height: sizeOf(maps.y) * scale + margin.top + margin.bottom };
}

const withUnit = (text: string, symbol: string) => (symbol ? `${text}${symbol === "°" ? "" : " "}${symbol}` : text);
const valueText = (maps: Maps, value: number | null | undefined) => (value == null ? "no value" : withUnit(format(value, 4), maps.valueUnit.symbol));

export function MapPlot({ plot, table }: { plot: Plot; table: Table }) {
  const box = useRef<HTMLDivElement>(null);
  const [room, setRoom] = useState(500);
  const [place, setPlace] = useState<Place | null>(null);
  const [part, setPart] = useState<Box | null>(null);  // zoomed part, in all maps
  const maps = useMemo(() => mapsOf(plot, table), [plot, table]);
  useEffect(() => {
    const measure = () => setRoom(box.current!.clientWidth || 500);
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(box.current!);
    return () => observer.disconnect();
  }, []);
  const layout = useMemo(() => maps && layoutOf(maps, room), [maps, room]);
  if (!maps || !layout) return <div ref={box}><p class="note">No values.</p></div>;
  const [nx, ny] = [countOf(maps.x), countOf(maps.y)];
  const show = (i: number, j: number) => setPlace({ i: Math.min(nx - 1, Math.max(0, i)), j: Math.min(ny - 1, Math.max(0, j)) });
  const whole = wholeOf(maps);
  const seen = part ?? whole;
  /** The part moves with the place that is read by keys. */
  const follow = ({ i, j }: Place) => {
    const beyond = (axis: typeof maps.x, index: number, low: number, high: number) => {
      const v = at(axis, Math.min(countOf(axis) - 1, Math.max(0, index)));
      return Math.min(0, v - axis.pitch / 2 - low) + Math.max(0, v + axis.pitch / 2 - high);
    };
    if (!part) return;
    const [dx, dy] = [beyond(maps.x, i, part.left, part.right), beyond(maps.y, j, part.bottom, part.top)];
    if (dx || dy) setPart({ left: part.left + dx, right: part.right + dx, bottom: part.bottom + dy, top: part.top + dy });
  };
  const go = (i: number, j: number) => {
    show(i, j);
    follow({ i, j });
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 10 : 1;
    const now = place ?? { i: Math.floor(nx / 2), j: Math.floor(ny / 2) };
    const moves: Record<string, [number, number]> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    const move = moves[event.key];
    if (move) place ? go(now.i + move[0], now.j + move[1]) : go(now.i, now.j);
    else if (event.key === "Escape" && place) setPlace(null);
    else return;
    event.preventDefault();
    event.stopPropagation(); // elsewhere on the page these keys step through the motion
  };
  const alone = maps.levels.length === 1 && maps.levels[0].label === "";
  const values = place ? maps.levels.map((l) => l.find(place.i, place.j)?.value) : [];
  const where = place && [maps.x, maps.y].map((axis, k) => `${[maps.xLabel, maps.yLabel][k].replace(/ \([^()]*\)$/, "")} ${withUnit(format(at(axis, k ? place.j : place.i), 5), maps.unit.symbol)}`).join(", ");
  const range = (l: Level) => {
    const known = l.cells.flatMap((c) => (c.value === null ? [] : [c.value]));
    const [low, high] = known.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
    return known.length ? `${format(low, 4)} to ${format(high, 4)}` : "no value";
  };
  return (
    <>
      <div class="diagram">
      <div class={`map${alone ? "" : " several"}`} ref={box} tabIndex={0} role="group" aria-label={`${plot.title}: map of ${maps.valueLabel}; the arrow keys read its values`} aria-description={mapHint}
        onKeyDown={onKey} onPointerLeave={(e) => e.pointerType === "mouse" && setPlace(null)}>
        {maps.levels.map((level, k) => (
          <figure style={{ width: `${layout.width}px` }}>
            {!alone && <figcaption>{level.label}{place && <b>{valueText(maps, values[k])}</b>}</figcaption>}
            <Panel maps={maps} level={level} layout={layout} place={place} show={show} whole={whole} seen={seen} zoom={setPart} keys={k === 0 ? box : undefined} label={`${level.label || plot.title}: ${range(level)}, equal axes`} />
          </figure>
        ))}
      </div>
      {part && <Reset onClick={() => setPart(null)} />}
      </div>
      <Bar maps={maps} marks={values.flatMap((v) => (v == null ? [] : [v]))} />
      <p class="note read" aria-live="polite">{where
        ? <>{where}: <b>{maps.levels.map((l, k) => (alone ? valueText(maps, values[k]) : `${valueText(maps, values[k])} (${l.label})`)).join(", ")}</b></>
        : <span class="screen-only">Point at a place to read its value{alone ? "" : " in every map"}.</span>}</p>
    </>
  );
}

function Panel({ maps, level, layout, place, show, whole, seen, zoom, keys, label }: {
  maps: Maps; level: Level; layout: { scale: number; width: number; height: number }; place: Place | null; show: (i: number, j: number) => void;
  whole: Box; seen: Box; zoom: (part: Box | null) => void; keys?: RefObject<HTMLDivElement>; label: string;
}) {
  const { width, height } = layout;
  const [w, h] = [width - margin.left - margin.right, height - margin.top - margin.bottom];
  const svg = useRef<SVGSVGElement>(null);
  const [drag, setDrag] = useState<[Spot, Spot] | null>(null);
  const paths = useMemo(() => pathsOf(maps, level, layout.scale), [maps, level, layout.scale]);
  const scale = w / (seen.right - seen.left);
  const x = (v: number) => margin.left + (v - seen.left) * scale;
  const y = (v: number) => height - margin.bottom - (v - seen.bottom) * scale;
  const step = niceStep(110 / scale); // 44 px or more, since steps grow by 2.5 at most
  const named = (v: number) => format(Math.abs(v) < step * 1e-6 ? 0 : v, 6);
  const live = useRef(seen);
  live.current = seen;
  useEffect(() => {
    const element = svg.current!;
    /** Limits a point in px on the screen, where the drawing may be smaller, within the axes. */
    const within = (p: Spot): Spot => {
      const drawn = width / (element.clientWidth || width);
      return { x: p.x * drawn - margin.left, y: p.y * drawn - margin.top };
    };
    const placeOf = (p: Spot) => {
      const { left, right, bottom, top } = live.current;
      return { x: left + (p.x / w) * (right - left), y: top - (p.y / h) * (top - bottom) };
    };
    const [wholeX, wholeY] = [[whole.left, whole.right], [whole.bottom, whole.top]] as Range[];
    const nowX = () => [live.current.left, live.current.right] as Range;
    const nowY = () => [live.current.bottom, live.current.top] as Range;
    const part = (across: Range | null, up: Range | null) => zoom(across && up && { left: across[0], right: across[1], bottom: up[0], top: up[1] });
    return listen(element, keys?.current ?? (element as unknown as HTMLElement), {
      zoomed: () => false, // the arrows read values
      box: (from, to, done) => {
        setDrag(done ? null : [from, to].map(within) as [Spot, Spot]);
        if (!done) return;
        const [a, b] = [placeOf(within(from)), placeOf(within(to))];
        const box = boxAbout({ left: Math.min(a.x, b.x), right: Math.max(a.x, b.x), bottom: Math.min(a.y, b.y), top: Math.max(a.y, b.y) }, whole);
        part(box.x, box.y);
      },
      cancel: () => setDrag(null),
      zoom: (factor, about) => {
        const p = placeOf(about ? within(about) : { x: w / 2, y: h / 2 });
        part(nearer(nowX(), wholeX, p.x, factor), nearer(nowY(), wholeY, p.y, factor));
      },
      move: (dx, dy) => part(shifted(nowX(), wholeX, -dx / w), shifted(nowY(), wholeY, dy / h)),
      reset: () => zoom(null),
      click: () => {},
      mark: () => {},
      unmark: () => {},
    });
  }, [whole.left, whole.right, whole.bottom, whole.top, width, height, keys]);
  const read = (event: PointerEvent) => {
    if (event.buttons && event.pointerType === "mouse") return; // a drag
    const box = (event.currentTarget as Element).getBoundingClientRect();
    const zoomed = width / (box.width || width);
    const [px, py] = [(event.clientX - box.left) * zoomed, (event.clientY - box.top) * zoomed];
    show(indexOf(maps.x, seen.left + (px - margin.left) / scale), indexOf(maps.y, seen.bottom + (height - margin.bottom - py) / scale));
  };
  // Cells were drawn for all of the map; what is seen of them is a part of it.
  const shown = `${(seen.left - whole.left) * layout.scale} ${(whole.top - seen.top) * layout.scale} ${(seen.right - seen.left) * layout.scale} ${(seen.top - seen.bottom) * layout.scale}`;
  const plane = { x: margin.left, y: margin.top, width: w, height: h };
  const [cw, ch] = [maps.x.pitch * scale, maps.y.pitch * scale];
  const dragged = drag && boxWithin(drag[0], drag[1], w, h);
  return (
    <svg ref={svg} viewBox={`0 0 ${width.toFixed(1)} ${height.toFixed(1)}`} role="img" aria-label={label} onPointerMove={read} onPointerDown={read}>
      <svg class="cells" {...plane} viewBox={shown} preserveAspectRatio="none" shape-rendering="crispEdges">
        {paths.map((d, k) => d && <path d={d} class={k < classes ? undefined : "none"} fill={k < classes ? classColour(k) : undefined} />)}
      </svg>
      <g class="axes">
        <path d={`M${margin.left} ${margin.top}H${width - margin.right}V${height - margin.bottom}H${margin.left}z${ticks(seen.left, seen.right, step).map((t) => `M${x(t).toFixed(1)} ${height - margin.bottom}v4`).join("")}${ticks(seen.bottom, seen.top, step).map((t) => `M${margin.left} ${y(t).toFixed(1)}h-4`).join("")}`} />
        {ticks(seen.left, seen.right, step).map((t) => <text x={x(t)} y={height - margin.bottom + 16} text-anchor="middle">{named(t)}</text>)}
        {ticks(seen.bottom, seen.top, step).map((t) => <text x={margin.left - 7} y={y(t) + 4} text-anchor="end">{named(t)}</text>)}
        <text class="name" x={(margin.left + width - margin.right) / 2} y={height - 6} text-anchor="middle">{maps.xLabel}</text>
        <text class="name" transform={`translate(11,${(height - margin.bottom) / 2}) rotate(-90)`} text-anchor="middle">{maps.yLabel}</text>
      </g>
      {place && (
        <svg {...plane} viewBox={`${margin.left} ${margin.top} ${w} ${h}`} class="within-axes">
          <g class="at" transform={`translate(${x(at(maps.x, place.i)).toFixed(2)},${y(at(maps.y, place.j)).toFixed(2)})`}>
            {["halo", "line"].map((name) => <rect class={name} x={-cw / 2 - 1} y={-ch / 2 - 1} width={cw + 2} height={ch + 2} />)}
          </g>
        </svg>
      )}
      {dragged && <rect class="drag" x={margin.left + dragged.left} y={margin.top + dragged.top} width={dragged.right - dragged.left} height={dragged.bottom - dragged.top} />}
    </svg>
  );
}

/** The one scale of colours, with the values that are read marked on it. */
function Bar({ maps, marks }: { maps: Maps; marks: number[] }) {
  const [width, left, height] = [420, 12, 12];
  const length = maps.missing ? 300 : width - 2 * left;
  const span = maps.high - maps.low;
  const share = (scaled: number) => (span > 0 ? (scaled - maps.low) / span : 0.5);
  const px = (scaled: number) => left + length * share(scaled);
  const step = niceStep(span / 4);
  const inner = span > 0 ? ticks(maps.low, maps.high, maps.logarithmic ? Math.max(1, step) : step).filter((v) => share(v) > 0.16 && share(v) < 0.84) : [];
  const text = (v: number, digits: number) => format(maps.logarithmic ? 10 ** v : v, digits);
  return (
    <svg class="colours" viewBox={`0 0 ${width} 58`} role="img" aria-label={`Colours from ${text(maps.low, 3)} (dark) to ${text(maps.high, 3)} (light): ${maps.valueLabel}`}>
      <g shape-rendering="crispEdges">
        {Array.from({ length: classes }, (_, k) => <rect x={left + (k * length) / classes} y={8} width={length / classes} height={height} fill={classColour(span > 0 ? k : classOf(0, 0, 0))} />)}
        {maps.missing && <rect class="none" x={left + length + 18} y={8} width={20} height={height} />}
      </g>
      {marks.map((v) => <path class="mark-at" d={`M${px(scaledOf(maps, v)).toFixed(1)} 8l-4 -7h8z`} />)}
      {span > 0 ? [maps.low, maps.high].map((v) => <text x={px(v)} y={34} text-anchor={v === maps.low ? "start" : "end"}>{text(v, 3)}</text>) : <text x={px(maps.low)} y={34} text-anchor="middle">{text(maps.low, 6)}</text>}
      {inner.map((v) => <text x={px(v)} y={34} text-anchor="middle">{text(v, 5)}</text>)}
      {maps.missing && <text x={left + length + 42} y={18}>no value</text>}
      <text class="name" x={left + length / 2} y={52} text-anchor="middle">{maps.valueLabel}</text>
    </svg>
  );
}
