// SPDX-License-Identifier: MIT
#ifndef ATLAS_REPORT_INTERNAL_REPORT_PAGE_H
#define ATLAS_REPORT_INTERNAL_REPORT_PAGE_H

namespace Atlas::internal {

/// The head of the page; `@TITLE@` is replaced.
inline constexpr const char* report_head = R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>@TITLE@ &ndash; texture atlas</title>
<style>
body{font:15px/1.5 system-ui,sans-serif;margin:0;color:#24262b;background:#f4f4f1}
main{max-width:1180px;margin:0 auto;padding:24px}
h1{font-size:24px;margin:0 0 4px}h2{font-size:17px;margin:0 0 10px}
section{background:#fff;border:1px solid #deded8;border-radius:8px;padding:16px;margin:16px 0}
.verdict{display:inline-block;padding:2px 12px;border-radius:12px;color:#fff;font-weight:600}
.valid{background:#2c8a4b}.invalid{background:#c02a2a}
.two{display:grid;grid-template-columns:repeat(auto-fit,minmax(340px,1fr));gap:16px}
.two section{margin:0}img{max-width:100%;border:1px solid #e4e4de}
table{border-collapse:collapse;width:100%}td,th{padding:3px 10px 3px 0;text-align:left;border-bottom:1px solid #eee}
td:last-child,th:last-child{text-align:right;font-variant-numeric:tabular-nums;padding-right:0}
canvas{width:100%;height:560px;display:block;touch-action:none;cursor:grab;background:#fbfbfa;border:1px solid #e4e4de}
button{font:inherit;padding:4px 14px;border:1px solid #bbb;border-radius:6px;background:#fff;cursor:pointer;margin:0 6px 10px 0}
button.on{background:#24262b;color:#fff}
.scale{height:16px;background:linear-gradient(90deg,#365ca8,#62a8cc,#def0ce,#fcca68,#e8623a,#960a1e)}
.ticks{display:flex;justify-content:space-between;font-size:12px}
svg{width:100%;height:auto}svg text{font-size:11px;fill:#555}
p.note{color:#666;font-size:13px;margin:6px 0 0}
</style></head><body><main>
)html";

/// The view of the model; `@DATA@` is replaced by an object of base64 strings.
inline constexpr const char* report_view = R"html(<section><h2>The model</h2>
<div id="modes"></div><canvas id="view"></canvas>
<p class="note">Drag to turn, scroll or pinch to zoom, double-click to reset.</p></section>
<script>
"use strict";
const data=@DATA@;
(function(){
const canvas=document.getElementById("view"),gl=canvas.getContext("webgl2",{antialias:true,preserveDrawingBuffer:true});
if(!gl){canvas.replaceWith("This browser has no WebGL 2.");return;}
const bytes=s=>Uint8Array.from(atob(s),c=>c.charCodeAt(0)).buffer;
const vertexSource=`#version 300 es
in vec3 position;in vec2 uv;out vec3 place;out vec2 coordinates;uniform mat3 turn;uniform float zoom,aspect;
void main(){place=turn*position;coordinates=uv;vec3 p=place*zoom;
gl_Position=vec4(p.x/max(aspect,1.),p.y*min(aspect,1.),-p.z*0.05,1.);}`;
const fragmentSource=`#version 300 es
precision highp float;in vec3 place;in vec2 coordinates;out vec4 color;uniform sampler2D picture;uniform int mode;uniform float squares;
void main(){vec3 normal=normalize(cross(dFdx(place),dFdy(place)));
float light=.42+.5*max(dot(normal,normalize(vec3(-.35,.55,.9))),0.)+.12*max(normal.z,0.);
vec3 base=vec3(.82);
if(mode==0){vec2 f=coordinates*squares,w=max(fwidth(f),1e-6),s=abs(fract(f*.5)-.5)*2.;
vec2 k=clamp((s-.5)/w+.5,0.,1.);float check=mix(k.x,1.-k.x,k.y);
float keep=clamp(1.5-max(w.x,w.y),0.,1.);check=mix(.5,check,keep);
vec3 hue=.5+.5*cos(6.2832*(vec3(0.,.33,.67)+.45*(coordinates.x+1.-coordinates.y)));
base=mix(mix(vec3(.35),hue,.45),mix(vec3(1.),hue,.12),check);}
else if(mode<3)base=texture(picture,vec2(coordinates.x,1.-coordinates.y)).rgb;
color=vec4(base*light,1.);}`;
const compile=(type,source)=>{const s=gl.createShader(type);gl.shaderSource(s,source);gl.compileShader(s);
if(!gl.getShaderParameter(s,gl.COMPILE_STATUS))throw gl.getShaderInfoLog(s);return s;};
const program=gl.createProgram();
gl.attachShader(program,compile(gl.VERTEX_SHADER,vertexSource));gl.attachShader(program,compile(gl.FRAGMENT_SHADER,fragmentSource));
gl.linkProgram(program);gl.useProgram(program);
const attribute=(name,size,values)=>{const place=gl.getAttribLocation(program,name);if(place<0)return;
gl.bindBuffer(gl.ARRAY_BUFFER,gl.createBuffer());gl.bufferData(gl.ARRAY_BUFFER,values,gl.STATIC_DRAW);
gl.enableVertexAttribArray(place);gl.vertexAttribPointer(place,size,gl.FLOAT,false,0,0);};
attribute("position",3,new Float32Array(bytes(data.positions)));attribute("uv",2,new Float32Array(bytes(data.uv)));
const indices=new Uint32Array(bytes(data.indices));
gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER,gl.createBuffer());gl.bufferData(gl.ELEMENT_ARRAY_BUFFER,indices,gl.STATIC_DRAW);
const uniform=name=>gl.getUniformLocation(program,name);
const pictures=["page","stretch"].map(id=>{const texture=gl.createTexture(),image=document.getElementById(id);
const load=()=>{gl.bindTexture(gl.TEXTURE_2D,texture);gl.texImage2D(gl.TEXTURE_2D,0,gl.RGBA,gl.RGBA,gl.UNSIGNED_BYTE,image);
gl.generateMipmap(gl.TEXTURE_2D);gl.texParameteri(gl.TEXTURE_2D,gl.TEXTURE_MIN_FILTER,gl.LINEAR_MIPMAP_LINEAR);draw();};
if(image.complete)setTimeout(load);else image.onload=load;return texture;});
let azimuth,elevation,zoom,mode=0;
const reset=()=>{azimuth=-.5;elevation=.3;zoom=1;};reset();
function draw(){
const w=Math.round(canvas.clientWidth*devicePixelRatio),h=Math.round(canvas.clientHeight*devicePixelRatio);
if(canvas.width!==w||canvas.height!==h){canvas.width=w;canvas.height=h;}
gl.viewport(0,0,w,h);gl.clearColor(.984,.984,.98,1);gl.clear(gl.COLOR_BUFFER_BIT|gl.DEPTH_BUFFER_BIT);gl.enable(gl.DEPTH_TEST);
const ca=Math.cos(azimuth),sa=Math.sin(azimuth),ce=Math.cos(elevation),se=Math.sin(elevation);
gl.uniformMatrix3fv(uniform("turn"),false,[ca,sa*se,-sa*ce,0,ce,se,sa,-ca*se,ca*ce]);
gl.uniform1f(uniform("zoom"),zoom*.96);gl.uniform1f(uniform("aspect"),w/h);gl.uniform1f(uniform("squares"),data.squares);
gl.uniform1i(uniform("mode"),mode);gl.bindTexture(gl.TEXTURE_2D,pictures[mode===2?1:0]);
gl.drawElements(gl.TRIANGLES,indices.length,gl.UNSIGNED_INT,0);}
["Checkerboard","Charts","Stretch","Plain"].forEach((name,i)=>{const b=document.createElement("button");b.textContent=name;
b.className=i===mode?"on":"";b.onclick=()=>{mode=i;[...b.parentNode.children].forEach(o=>o.className=o===b?"on":"");draw();};
document.getElementById("modes").append(b);});
const pointers=new Map();let spread=0;
canvas.onpointerdown=e=>{pointers.set(e.pointerId,[e.clientX,e.clientY]);canvas.setPointerCapture(e.pointerId);spread=0;};
canvas.onpointerup=canvas.onpointercancel=e=>{pointers.delete(e.pointerId);spread=0;};
canvas.onpointermove=e=>{const before=pointers.get(e.pointerId);if(!before)return;
pointers.set(e.pointerId,[e.clientX,e.clientY]);
if(pointers.size===1){azimuth+=(e.clientX-before[0])*.008;
elevation=Math.max(-1.57,Math.min(1.57,elevation+(e.clientY-before[1])*.008));}
else{const[a,b]=[...pointers.values()],d=Math.hypot(a[0]-b[0],a[1]-b[1]);if(spread)zoom*=d/spread;spread=d;}draw();};
canvas.onwheel=e=>{e.preventDefault();zoom=Math.max(.2,Math.min(200,zoom*Math.exp(-e.deltaY*.0015)));draw();};
canvas.ondblclick=()=>{reset();draw();};
addEventListener("resize",draw);draw();
})();
</script>
)html";

} // namespace Atlas::internal

#endif
